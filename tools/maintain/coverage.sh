#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Line and branch coverage of lib/ by the C tests: tools/maintain/coverage.sh. Writes docs/measurements/coverage.md; details are in
# build/coverage/index.html.
set -euo pipefail
cd "$(dirname "$0")/../.."
source tools/maintain/packages.sh
need_packages "${build_packages[@]}" xz-utils gcovr
tools/maintain/unity.sh

cmake --preset host-coverage > /dev/null
cmake --build --preset host-coverage > /dev/null
find build/host-coverage -name '*.gcda' -delete
ctest --preset host-coverage --output-on-failure > build/host-coverage/ctest.log || {
    tail -n 30 build/host-coverage/ctest.log >&2
    exit 1
}
mkdir -p build/coverage
gcovr --root . --filter lib/ --filter include/ --object-directory build/host-coverage --html-details build/coverage/index.html \
    --txt build/coverage/lines.txt build/host-coverage
gcovr --root . --filter lib/ --filter include/ --branches build/host-coverage | tee build/coverage/branches.txt
gcovr --root . --filter lib/ --filter include/ --json-summary build/coverage/summary.json build/host-coverage
python3 - build/coverage/summary.json > docs/measurements/coverage.md << 'END'
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    summary = json.load(file)
print("# Coverage\n\nWritten by `tools/maintain/coverage.sh`: `lib/` and `include/` by the C tests.\n")
print("| what | of | taken | left | share |\n| --- | --- | --- | --- | --- |")
for what in ("line", "branch"):
    total, taken = summary[f"{what}_total"], summary[f"{what}_covered"]
    print(f"| {what} | {total} | {taken} | {total - taken} | {100 * taken / total:.1f} % |")
END
