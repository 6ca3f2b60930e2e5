#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds zephyr/samples/hub for mps2/an386 and plays the bundled recording to it in QEMU: ZEPHYR_BASE=FOLDER tools/maintain/zephyr.sh
#
# Needs a Zephyr workspace (west init, west update cmsis cmsis_6) and what Zephyr asks for; Debian's compiler does for the toolchain unless
# ZEPHYR_TOOLCHAIN_VARIANT names another. Exit status 77 if ZEPHYR_BASE is not set, 1 if board and PC differ.
set -euo pipefail
cd "$(dirname "$0")/../.."

if [[ -z ${ZEPHYR_BASE:-} ]]; then
    echo "tools/maintain/zephyr.sh: set ZEPHYR_BASE to a tree of Zephyr" >&2
    exit 77
fi
if [[ -z ${ZEPHYR_TOOLCHAIN_VARIANT:-} ]]; then
    export ZEPHYR_TOOLCHAIN_VARIANT=cross-compile CROSS_COMPILE=/usr/bin/arm-none-eabi-
fi
out=build/zephyr_demo
cmake -S zephyr/samples/hub -B "$out/image" -G Ninja -D BOARD=mps2/an386
cmake --build "$out/image" --parallel 2
cmake --preset host -B "$out/host" -D JOINTCAL_BUILD_TESTS=OFF > /dev/null
cmake --build "$out/host" --target jointcal_program --parallel 2 > /dev/null

run=$(mktemp -d)
qemu=
cleanup() {
    [[ -z $qemu ]] || { kill "$qemu" && wait "$qemu"; } 2> /dev/null || true
    rm -rf "$run"
}
trap cleanup EXIT
qemu-system-arm -M mps2-an386 -display none -monitor none -serial "unix:$run/uart,server=on,wait=off" \
    -kernel "$out/image/zephyr/zephyr.elf" < /dev/null > "$out/qemu.log" 2>&1 &
qemu=$!
for ((k = 0; k < 100; k++)); do
    [[ -S $run/uart ]] && break
    sleep 0.05
done
recording=tools/demo/hinge_demo.csv
"$out/host/jointcal" stream "$recording" --to "unix:$run/uart" --every 5 --speed max > "$out/hub.jsonl"
"$out/host/jointcal" hinge "$recording" --json --every 5 > "$out/pc.jsonl"
cmp "$out/hub.jsonl" "$out/pc.jsonl"
echo "The hub under Zephyr says the same as the PC, to the byte: $(wc -l < "$out/hub.jsonl") lines."
