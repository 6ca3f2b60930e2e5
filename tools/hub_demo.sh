#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Plays the bundled recording to the hub's firmware on an emulated Cortex-M4F board: tools/hub_demo.sh [--speed X] [--board BOARD]
#
# Installs what is missing (as root; otherwise it prints the command), builds the program and the firmware image, starts the
# image in QEMU with its UART on a socket, and shows what it finds, beside what the PC finds from the same recording.
# BOARD is mps2_an386 (default) or stm32f405; port/boards/README.md tells about them.
# --check plays as fast as it goes, prints no more than needed, and fails unless both are the same bytes.
set -euo pipefail
cd "$(dirname "$0")/.."
source tools/maintain/packages.sh

check=false speed=10 board=mps2_an386
while (($# > 0)); do
    case $1 in
    --check) check=true speed=max && shift ;;
    --speed) speed=${2:?--speed needs a number or max} && shift 2 ;;
    --board) board=${2:?--board needs a name} && shift 2 ;;
    *) echo "usage: tools/hub_demo.sh [--check] [--speed X] [--board BOARD]" >&2 && exit 2 ;;
    esac
done
case $board in
mps2_an386) machine=mps2-an386 ;;
stm32f405) machine=netduinoplus2 ;;
*) echo "tools/hub_demo.sh: there is no emulator for the board '$board', only mps2_an386 and stm32f405" >&2 && exit 2 ;;
esac

# 77: CTest takes it for skipped.
need_packages "${build_packages[@]}" gcc-arm-none-eabi picolibc-arm-none-eabi qemu-system-arm || exit 77
out=build/hub_demo
mkdir -p "$out"
build() { # PRESET TARGET: in a folder of the demo's own, so that other builds keep their configuration
    { cmake --preset "$1" -B "$out/$1" -D JOINTCAL_BUILD_TESTS=OFF -D JOINTCAL_BOARDS=ON &&
        cmake --build "$out/$1" --target "$2" --parallel 2; } > "$out/build-$1.log" 2>&1 || {
        tail -n 30 "$out/build-$1.log" >&2
        exit 1
    }
}
echo "Building the program and the firmware (logs: $out/build-*.log)"
build host jointcal_program
build m4f "hub_$board"

# A path of a socket may have 107 bytes, and the repository may lie deeper than that.
run=$(mktemp -d)
qemu=
cleanup() {
    [[ -z $qemu ]] || { kill "$qemu" && wait "$qemu"; } 2> /dev/null || true
    rm -rf "$run"
}
trap cleanup EXIT
qemu-system-arm -M "$machine" -display none -monitor none -serial "unix:$run/uart,server=on,wait=off" \
    -kernel "$out/m4f/hub_$board.elf" < /dev/null > "$out/qemu.log" 2>&1 &
qemu=$!
for ((k = 0; k < 100; k++)); do
    [[ -S $run/uart ]] && break
    sleep 0.05
done

recording=tools/demo/hinge_demo.csv
show() {
    sed -E 's/"(engine|weak|hint|samples|rejected|sign_margin)": [^,]*, //g; s/, "rejected_by".*/}/' "$1"
}
printf '\n$ jointcal stream %s --to unix:UART --every 5 --speed %s\n' "$recording" "$speed"
"$out/host/jointcal" stream "$recording" --to "unix:$run/uart" --every 5 --speed "$speed" --counters > "$out/hub.jsonl"
$check || show "$out/hub.jsonl"
"$out/host/jointcal" hinge "$recording" --json --every 5 > "$out/pc.jsonl"
if cmp "$out/hub.jsonl" "$out/pc.jsonl"; then
    echo "The emulated board says the same as the PC, to the byte: $(wc -l < "$out/hub.jsonl") lines."
else
    echo "The emulated board and the PC differ: $out/hub.jsonl, $out/pc.jsonl" >&2
    exit 1
fi
