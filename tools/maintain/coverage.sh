#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Line and branch coverage of lib/ by the C tests: tools/maintain/coverage.sh. Details in build/coverage/index.html.
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
