#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds and tests for Cortex-M processors in QEMU: tools/test_target.sh [all | quick | PRESET...]
#
# Installs what is missing (as root; otherwise it prints the command). all (the default, part of tools/test.sh): every unit test on
# m4f, m3, m7 and m33, same bits on host and targets, the hub in QEMU, the budget. quick: m4f, hub and budget. PRESET: its tests only.
# Log files go to build/logs.
set -euo pipefail
cd "$(dirname "$0")/.."
source tools/maintain/packages.sh

logs=build/logs
mkdir -p "$logs"
need_packages "${build_packages[@]}" "${target_packages[@]}" xz-utils python3-venv
tools/maintain/unity.sh
tools/vqf.sh

what=${1:-all}
case $what in
all) presets=(m4f m3 m7 m33) ;;
quick) presets=(m4f) ;;
*) presets=("$@") ;;
esac
for preset in "${presets[@]}"; do
    printf '\n== Target, preset %s\n' "$preset"
    cmake --preset "$preset" > "$logs/configure-$preset.log"
    cmake --build --preset "$preset"
    ctest --preset "$preset" -j2 | tee "$logs/ctest-$preset.log"
done

if [[ $what == all ]]; then
    printf '\n== Same bits\n'
    tools/same_bits.py --no-write
fi
if [[ $what == all || $what == quick ]]; then
    printf '\n== Hub in QEMU, as on the PC\n'
    tools/hub_demo.sh --check
    tools/hub_demo.sh --check --board stm32f405
    printf '\n== Budget\n'
    tools/budget.py --check
fi
