#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds and runs the fuzzers under address and undefined behaviour sanitizers: tools/maintain/fuzz.sh [RUNS [TARGET...]]
#
# RUNS executions of the reader (default 20000), of one sensor, its health, of packets and of kept calibrations, a tenth as many of pairing, which estimates lags, and a hundredth as many of push, joints, auto and two_axes, each of which
# pushes tens of samples into the engines of the hinge, of all other joints, or of a hinge of either kind and the functional joint alone, or of a
# joint with two axes; corruptions of the memory of running estimators, a hundredth as many of each (corrupt.c); of the hub's frames as many as of the reader, and then `fuzz.sh frames` with ten
# times as many frames. Inputs that reach new code are kept in build/fuzz; host_tests/fuzz/corpus is where every run starts.
# `fuzz.sh merge` copies what is worth keeping there.
set -euo pipefail
cd "$(dirname "$0")/../.."
source tools/maintain/packages.sh
need_packages clang-14 libclang-rt-14-dev || exit 1

# tools/maintain/fuzz.sh frames [COUNT]: feeds COUNT (default 10 million) random and damaged frames to the decoder and holds what it
# accepts against the odds of the CRC; 10 million and more write docs/measurements/frames.md.
frames() {
    local count=$1 report=build/fuzz/frames.md
    ((count >= 10000000)) && report=docs/measurements/frames.md
    mkdir -p build/fuzz
    clang-14 -std=c99 -g -O2 -Wall -Wextra -Werror -Iport/hub -fsanitize=address,undefined -fno-sanitize-recover=all \
        port/hub/frame.c host_tests/fuzz/run_frames.c -o build/fuzz/run_frames
    echo "run_frames: $count frames (report: $report)"
    build/fuzz/run_frames "$count" > build/fuzz/run_frames.txt || { cat build/fuzz/run_frames.txt >&2 && exit 1; }
    {
        printf '# Random and damaged frames\n\nWritten by `tools/maintain/fuzz.sh frames %s`, under address and undefined behaviour sanitizers.\n\n' "$count"
        printf 'Pieces are what the decoder had to judge: a damage that makes a zero makes two. Accepted: frames that came out of a\n'
        printf 'damaged piece. Frames that the damage left as they were do not count; they must be accepted, and were.\n\n'
        printf '| kind | frames | pieces | accepted |\n| --- | --- | --- | --- |\n'
        sed '/^|/!s/^/\n/' build/fuzz/run_frames.txt
    } > "$report"
    tail -n 1 "$report"
}
if [[ ${1:-} == frames ]]; then
    frames "${2:-10000000}"
    exit 0
fi

runs=${1:-20000}
shift || true
targets=("$@")
((${#targets[@]} > 0)) || targets=(reader push joints auto two_axes sensor health packets pairing keep corrupt frame)
out=build/fuzz
mkdir -p "$out"

flags=(-std=c99 -g -O1 -D_POSIX_C_SOURCE=200809L -ffp-contract=off -Wall -Wextra -Werror -Iinclude -Ilib -Itools/cli -Iport/hub
    -fsanitize=fuzzer,address,undefined,float-cast-overflow -fno-sanitize-recover=all
    -fsanitize-recover=bool)
# Corrupted memory has bools that are neither; everywhere else they are an error as any other.
export UBSAN_OPTIONS=halt_on_error=1
mapfile -t library < <(find lib -name '*.c' | sort)
hub=(port/hub/frame.c port/hub/messages.c port/hub/body_messages.c port/hub/hub_pair.c port/hub/hub_body.c port/hub/hub.c)
reader=(tools/cli/input/{check,check_frames,check_health,check_sensor,check_time,csv,file_kind,header_help,kept_rows,number,recording}.c)

# What the fuzzers share is compiled once, on all cores; an object that failed is missing when the fuzzer is linked.
objects=$out/objects
rm -rf "$objects"
mkdir -p "$objects"
object_of() { printf '%s/%s.o' "$objects" "${1//\//_}"; }
for source in "${library[@]}" "${hub[@]}" "${reader[@]}"; do
    while (($(jobs -rp | wc -l) >= $(nproc))); do
        wait -n
    done
    clang-14 "${flags[@]}" -c "$source" -o "$(object_of "$source")" &
done
wait

for target in "${targets[@]}"; do
    sources=("${library[@]}")
    [[ $target == reader ]] && sources+=("${reader[@]}")
    [[ $target == frame ]] && sources+=("${hub[@]}")
    linked=()
    for source in "${sources[@]}"; do
        linked+=("$(object_of "$source")")
    done
    if [[ $target == corrupt ]]; then
        count=${CORRUPTIONS:-$((runs / 100))}
        clang-14 "${flags[@]/fuzzer,/fuzzer-no-link,}" -D_GNU_SOURCE -Ihost_tests host_tests/fuzz/corrupt.c "${linked[@]}" -o "$out/corrupt" -lm
        echo "corrupt: $count of each (log: $out/corrupt.log)"
        if ! UBSAN_OPTIONS=halt_on_error=0 "$out/corrupt" "$count" > "$out/corrupt.txt" 2> "$out/corrupt.log"; then
            grep -E 'BROKEN|ERROR|runtime error' "$out/corrupt.log" | tail -n 20 >&2
            exit 1
        fi
        continue
    fi
    clang-14 "${flags[@]}" "host_tests/fuzz/fuzz_$target.c" "${linked[@]}" -o "$out/fuzz_$target" -lm
    corpus=host_tests/fuzz/corpus/$target
    mkdir -p "$out/$target"
    if [[ $runs == merge ]]; then
        "$out/fuzz_$target" -merge=1 "$corpus" "$out/$target" 2> "$out/$target.log"
        continue
    fi
    count=$runs
    length=8192
    if [[ $target == push || $target == joints || $target == auto || $target == two_axes ]]; then
        count=$((runs / 100))
        length=2604
    fi
    if [[ $target == pairing ]]; then
        count=$((runs / 10))
        length=2048
    fi
    # 31 packets and less, up to eight times: long inputs reach nothing more, and cost ten times as much.
    [[ $target == packets ]] && length=256
    # The fixed seed makes a short run the same every time.
    echo "fuzz_$target: $count runs (log: $out/$target.log)"
    if ! "$out/fuzz_$target" -runs="$count" -seed=1 -max_len="$length" -timeout=20 -print_final_stats=1 \
        -dict=host_tests/fuzz/reader.dict -artifact_prefix="$out/" "$out/$target" "$corpus" 2> "$out/$target.log"; then
        tail -n 40 "$out/$target.log" >&2
        exit 1
    fi
    sed -n 's/^stat::number_of_executed_units: */  executed: /p; s/^stat::peak_rss_mb: */  peak memory, MB: /p' \
        "$out/$target.log"
done
[[ $runs == merge || $runs == 0 ]] || frames "$((runs * 10))"
