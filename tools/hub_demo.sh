#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Shows what a hub does: tools/hub_demo.sh [--pc] [--hinge] [--speed X] [--board BOARD]
#
# A leg with sensors on pelvis, thigh and shank: hip and knee become ready, the hub is switched off and on again, and remembers. The hub is the
# firmware on an emulated Cortex-M4F board; with --pc it is the same code as a program, and nothing is emulated. --hinge plays one hinge instead.
#
# Installs what is missing (as root; otherwise it prints the command), builds the program and the firmware image, starts the image in QEMU
# with its UART on a socket, and shows what it finds, beside what the PC finds from the same recording.
# BOARD is mps2_an386 (default) or stm32f405; port/boards/README.md tells about them. The emulated stm32f405 has no flash to keep anything in.
# --check plays leg and hinge as fast as it goes, prints no more than needed, and fails unless both are the same bytes.
set -euo pipefail
cd "$(dirname "$0")/.."
source tools/maintain/packages.sh

check=false hinge=false pc=false speed=10 board=mps2_an386
while (($# > 0)); do
    case $1 in
    --check) check=true speed=max && shift ;;
    --hinge) hinge=true && shift ;;
    --pc) pc=true && shift ;;
    --speed) speed=${2:?--speed needs a number or max} && shift 2 ;;
    --board) board=${2:?--board needs a name} && shift 2 ;;
    *) echo "usage: tools/hub_demo.sh [--check] [--pc] [--hinge] [--speed X] [--board BOARD]" >&2 && exit 2 ;;
    esac
done
case $board in
mps2_an386) machine=mps2-an386 ;;
stm32f405) machine=netduinoplus2 ;;
*) echo "tools/hub_demo.sh: there is no emulator for the board '$board', only mps2_an386 and stm32f405" >&2 && exit 2 ;;
esac

# 77: CTest takes it for skipped.
needed=("${build_packages[@]}")
$pc || needed+=(gcc-arm-none-eabi picolibc-arm-none-eabi qemu-system-arm)
need_packages "${needed[@]}" || exit 77
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
build host jointcal_hub_program
$pc || build m4f "hub_$board"

# A path of a socket may have 107 bytes, and the repository may lie deeper than that.
run=$(mktemp -d)
qemu= host=
stop() { # PROCESS: at once, as a power cut is
    [[ -z $1 ]] || { kill -9 "$1" && wait "$1"; } 2> /dev/null || true
}
cleanup() {
    stop "$qemu"
    stop "$host"
    rm -rf "$run"
}
trap cleanup EXIT
wait_socket() {
    for ((k = 0; k < 100; k++)); do
        [[ -S $1 ]] && return
        sleep 0.05
    done
}
pc_on() { # its flash is a file
    rm -f "$run/pc"
    "$out/host/jointcal_hub" --flash "$run/flash" "unix:$run/pc" > /dev/null &
    host=$!
    wait_socket "$run/pc"
}
board_on() { # the monitor of QEMU listens to descriptor 3
    mkfifo "$run/monitor"
    exec 3<> "$run/monitor"
    qemu-system-arm -M "$machine" -display none -monitor stdio -serial "unix:$run/uart,server=on,wait=off" \
        -kernel "$out/m4f/hub_$board.elf" < "$run/monitor" > "$out/qemu.log" 2>&1 &
    qemu=$!
    wait_socket "$run/uart"
}
off_and_on() {
    if $pc; then
        stop "$host"
        pc_on
    else
        echo system_reset >&3 # flash, which is RAM on the emulated board, stays as it is
        sleep 0.5
    fi
}
jointcal=$out/host/jointcal
where=the\ emulated\ board
$pc && where=the\ PC\'s\ hub
if $pc; then
    pc_on
    uart=$run/pc
else
    board_on
    uart=$run/uart
fi

same() { # HUB PC: both are the same bytes
    if cmp "$1" "$2"; then
        echo "${where^} says the same as the PC, to the byte: $(wc -l < "$1") lines."
    else
        echo "${where^} and the PC differ: $1, $2" >&2
        exit 1
    fi
}

demo_hinge() {
    local recording=tools/demo/hinge_demo.csv
    printf '\n$ jointcal stream %s --to unix:UART --every 5 --speed %s\n' "$recording" "$speed"
    "$jointcal" stream "$recording" --to "unix:$uart" --every 5 --speed "$speed" --counters > "$out/hub.jsonl"
    $check || sed -E 's/"(engine|weak|hint|samples|rejected|sign_margin)": [^,]*, //g; s/, "rejected_by".*/}/' "$out/hub.jsonl"
    "$jointcal" hinge "$recording" --json --every 5 > "$out/pc.jsonl"
    same "$out/hub.jsonl" "$out/pc.jsonl"
}

leg=(tools/demo/leg_demo.csv --names "pelvis,thigh,shank" --joint hip:ball:pelvis:thigh --joint knee:hinge:thigh:shank --angles-every 1 --every 30)
[[ $board = stm32f405 ]] && ! $pc || leg+=(--keep)

# Events in plain words. Of angles the first of each joint, and the knee's every 15 s.
words() {
    awk '
        # What stands behind a key at its first place: a word, a number, or the first number of a list.
        function field(name, key, rest) {
            key = "\"" name "\": "
            if (!index($0, key)) return ""
            rest = substr($0, index($0, key) + length(key))
            sub(/^["[]/, "", rest)
            sub(/[",}].*/, "", rest)
            return rest
        }
        function tell(text) { printf "  %5.1f s  %s\n", field("t_s"), text; fflush() }
        { event = field("event"); joint = field("joint") }
        event == "lag_found" { tell("the motion shows how late the packets of both sensors of the " joint " are beside each other: " sprintf("%.0f", 1000 * field("lag_s")) " ms") }
        event == "ready" { tell("the " joint " is ready: its angle is known from now on") }
        event == "left_ready" { tell("the " joint " is not ready any more: " field("reason")) }
        event == "kept" { tell("the hub has written what it knows to flash") }
        event == "remembered" { tell("the hub remembers the " joint ", and waits for motion to confirm it") }
        event == "confirmed" { tell("the motion confirms what was remembered of the " joint) }
        event == "dropped" { tell("what was remembered of the " joint " does not hold: " field("reason")) }
        event == "advice" && field("joint") != "null" { tell("advice: " field("text")) }
        event == "angles" {
            if (field("hip") != "null" && !hip++) tell("the first angle of the hip")
            if (field("knee") != "null") {
                if (!knee++) tell("the first angle of the knee")
                if (field("t_s") + 0 >= due) { tell(sprintf("the angle of the knee is %.0f deg", field("knee") * 57.29578)); due = field("t_s") + 15 }
            }
        }
        event == "end" { tell("end of the recording: " (field("ready") == "true" ? "all joints are ready" : "not all joints are ready")) }'
}
play() { # HUB NAME: what it says goes to a file and, unless only checked, to the screen in words
    if $check || [[ $1 != "$uart" ]]; then
        "$jointcal" stream "${leg[@]}" --to "unix:$1" --speed max > "$out/$2.jsonl"
    else
        "$jointcal" stream "${leg[@]}" --to "unix:$1" --speed "$speed" | tee "$out/$2.jsonl" | words
    fi
}
say() {
    $check || printf '\n%s\n' "$1"
}
demo_leg() {
    local sessions=(evening)
    say "1. Evening, at $speed times the pace: three sensors are put on, and $where knows nothing. Watch hip and knee become ready."
    play "$uart" evening
    if [[ " ${leg[*]} " = *" --keep "* ]]; then
        say "2. The hub is switched off and on again."
        off_and_on
        say "3. Morning: the same sensors, the same leg. Watch how soon there are angles, beside the evening."
        play "$uart" morning
        sessions+=(morning)
    fi
    $pc && return
    say "4. The same packets to the same code on the PC."
    uart_of_pc=$run/pc
    for session in "${sessions[@]}"; do
        pc_on
        play "$uart_of_pc" "pc_$session"
        stop "$host"
        host=
        same "$out/$session.jsonl" "$out/pc_$session.jsonl"
    done
}
$hinge || demo_leg
if $hinge || $check; then demo_hinge; fi
