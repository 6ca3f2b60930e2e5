#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Calibrates a hinge joint from the bundled recording: tools/demo.sh
#
# Installs what is missing (as root; otherwise it prints the command), builds the program, runs it, draws a plot.
set -euo pipefail
cd "$(dirname "$0")/.."
source tools/maintain/packages.sh

need_packages "${build_packages[@]}" python3-numpy python3-matplotlib
mkdir -p build/demo
log=build/demo/build.log
echo "Building the program (log: $log)"
{ cmake --preset host -D JOINTCAL_BUILD_TESTS=OFF && cmake --build --preset host; } > "$log" 2>&1 || {
    tail -n 30 "$log" >&2
    exit 1
}

recording=tools/demo/hinge_demo.csv
printf '\n$ build/host/jointcal hinge %s\n' "$recording"
build/host/jointcal hinge "$recording"
printf '\n$ build/host/jointcal hinge %s --json --every 0.1 > build/demo/hinge.jsonl\n' "$recording"
build/host/jointcal hinge "$recording" --json --every 0.1 > build/demo/hinge.jsonl
tail -n 1 build/demo/hinge.jsonl

python=$(python_with numpy matplotlib)
printf '\nDrawing axis error, bounds, status and excitation over time\n'
"$python" tools/plot.py "$recording" --jsonl build/demo/hinge.jsonl --truth "${recording%.csv}.json" -o build/demo/hinge.png
echo "The plot is build/demo/hinge.png"
