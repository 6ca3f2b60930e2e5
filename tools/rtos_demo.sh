#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Plays the bundled recording to the hub under FreeRTOS on an emulated Cortex-M4F board: tools/rtos_demo.sh [--check] [--speed X]
#
# Installs what is missing (as root; otherwise it prints the command), fetches the kernel (tools/freertos.sh), builds the program and the
# image, starts the image in QEMU with its UART on a socket, and shows what it finds, beside what the PC finds from the same recording;
# then what the image says of its stacks. JOINTCAL_FREERTOS_ROOT names a kernel that is there already.
# --check plays as fast as it goes, and prints no more than needed. Fails unless both are the same bytes, no register of the FPU was lost
# between tasks, and each stack has an eighth left.
set -euo pipefail
cd "$(dirname "$0")/.."
source tools/maintain/packages.sh

check=false speed=10
while (($# > 0)); do
    case $1 in
    --check) check=true speed=max && shift ;;
    --speed) speed=${2:?--speed needs a number or max} && shift 2 ;;
    *) echo "usage: tools/rtos_demo.sh [--check] [--speed X]" >&2 && exit 2 ;;
    esac
done

# 77: CTest takes it for skipped.
need_packages "${build_packages[@]}" gcc-arm-none-eabi picolibc-arm-none-eabi qemu-system-arm || exit 77
kernel=$(tools/freertos.sh) || exit 77
out=build/rtos_demo
mkdir -p "$out"
build() { # PRESET TARGET: in a folder of the demo's own, so that other builds keep their configuration
    { cmake --preset "$1" -B "$out/$1" -D JOINTCAL_BUILD_TESTS=OFF -D JOINTCAL_BOARDS=ON -D JOINTCAL_FREERTOS_ROOT="$kernel" &&
        cmake --build "$out/$1" --target "$2" --parallel 2; } > "$out/build-$1.log" 2>&1 || {
        tail -n 30 "$out/build-$1.log" >&2
        exit 1
    }
}
echo "Building the program and the firmware (logs: $out/build-*.log)"
build host jointcal_program
build m4f hub_freertos
image=$out/m4f/hub_freertos.elf

# A path of a socket may have 107 bytes, and the repository may lie deeper than that.
run=$(mktemp -d)
qemu=
cleanup() {
    [[ -z $qemu ]] || { kill "$qemu" && wait "$qemu"; } 2> /dev/null || true
    rm -rf "$run"
}
trap cleanup EXIT
qemu-system-arm -M mps2-an386 -display none -monitor "unix:$run/monitor,server=on,wait=off" -serial "unix:$run/uart,server=on,wait=off" \
    -kernel "$image" < /dev/null > "$out/qemu.log" 2>&1 &
qemu=$!
for ((k = 0; k < 100; k++)); do
    [[ -S $run/uart && -S $run/monitor ]] && break
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
    echo "The hub under FreeRTOS says the same as the PC, to the byte: $(wc -l < "$out/hub.jsonl") lines."
else
    echo "The hub under FreeRTOS and the PC differ: $out/hub.jsonl, $out/pc.jsonl" >&2
    exit 1
fi

sleep 1.5 # the image counts its stacks once a second
address=$(arm-none-eabi-nm "$image" | sed -n 's/ . rtos_numbers$//p')
arm-none-eabi-size "$image"
python3 tools/maintain/rtos_numbers.py "$run/monitor" "0x$address"
