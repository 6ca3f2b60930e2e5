#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds and tests everything on this machine, as CI does: tools/test.sh
#
# Installs what is missing (as root; otherwise it prints the command), builds the presets host and host-debug with warnings
# as errors, runs CTest in both, then format, static analysis, fuzzers, Python tests, and regenerates generated files.
# Log files go to build/logs.
set -euo pipefail
cd "$(dirname "$0")/.."
source tools/maintain/packages.sh

logs=build/logs
mkdir -p "$logs"

step() { printf '\n== %s\n' "$*"; }

step "Tools"
need_packages "${build_packages[@]}" "${target_packages[@]}" pkg-config xz-utils clang-14 clang-format-14 clang-tidy-14 libclang-rt-14-dev \
    cppcheck python3-venv python3-numpy python3-matplotlib
python=$(python_with numpy matplotlib)
tools/maintain/unity.sh
tools/vqf.sh

for preset in host host-debug; do
    step "Build, preset $preset"
    cmake --preset "$preset" > "$logs/configure-$preset.log"
    cmake --build --preset "$preset"
done

step "Format"
cmake --build --preset host --target format_check
step "clang-tidy"
cmake --build --preset host --target tidy
step "cppcheck"
cmake --build --preset host --target cppcheck

for preset in host host-debug; do
    step "Tests, preset $preset"
    ctest --preset "$preset" | tee "$logs/ctest-$preset.log"
done

step "Fuzzers, a short run"
tools/maintain/fuzz.sh 20000

step "Python tests"
PYTHONPATH=tools/python "$python" -m unittest discover -s host_tests/python -t host_tests/python -v 2>&1 |
    tee "$logs/python.log"

for script in tools/maintain/make_golden.py tools/maintain/make_demo.py; do
    if [[ -e $script ]]; then
        step "Regeneration, $script --check"
        "$python" "$script" --check
    fi
done
step "Measurements, a short run"
"$python" tools/measure.py all --quick --no-qmt
step "Hub over a bad wire, a short run"
"$python" tools/maintain/hub_soak.py --minutes 1
step "Cortex-M processors in QEMU"
tools/test_target.sh
step "Hub in QEMU over a bad wire, a short run"
"$python" tools/maintain/hub_soak.py --minutes 1 --board mps2_an386
step "All steps passed"
