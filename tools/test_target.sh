#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds and tests for Cortex-M processors in QEMU: tools/test_target.sh [PRESET...]
#
# Installs what is missing (as root; otherwise it prints the command). m4f runs every unit test; on the others the long ones
# (tests_long below) are left out, because they take minutes each in QEMU and would exercise the same sources again; name
# presets to run all tests on them. Then: same bits on host and targets, the hub in QEMU, and the budget.
# Log files go to build/logs.
set -euo pipefail
cd "$(dirname "$0")/.."
source tools/packages.sh

logs=build/logs
mkdir -p "$logs"
need_packages "${build_packages[@]}" gcc-arm-none-eabi picolibc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm
tools/unity.sh

tests_long='test_(hinge_long|hinge_never|hinge_weights|hinge_window|hinge_judge|hinge_bounds|select_acc|hinge|hinge_refine|select)$'
presets=("$@")
((${#presets[@]})) || presets=(m4f m3 m7 m33)
for preset in "${presets[@]}"; do
    printf '\n== Target, preset %s\n' "$preset"
    cmake --preset "$preset" > "$logs/configure-$preset.log"
    cmake --build --preset "$preset"
    leave_out=()
    if (($# == 0)) && [[ $preset != m4f ]]; then
        leave_out=(--exclude-regex "$tests_long")
        echo "Left out here, run with m4f: $tests_long"
    fi
    ctest --preset "$preset" -j2 "${leave_out[@]}" | tee "$logs/ctest-$preset.log"
done

if (($# == 0)); then
    printf '\n== Same bits\n'
    tools/same_bits.py
    printf '\n== Hub in QEMU, as on the PC\n'
    tools/hub_demo.sh --check
    tools/hub_demo.sh --check --board stm32f405
    printf '\n== Budget\n'
    tools/budget.py --check
fi
