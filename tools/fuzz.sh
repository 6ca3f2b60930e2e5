#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds and runs the fuzzers under address and undefined behaviour sanitizers: tools/fuzz.sh [RUNS [TARGET...]]
#
# RUNS executions of the reader (default 20000) and a hundredth as many of push, each of which pushes up to 50 samples into
# both engines. Inputs that reach new code are kept in build/fuzz; host_tests/fuzz/corpus is where every run starts. tools/fuzz.sh merge copies what is worth keeping there.
set -euo pipefail
cd "$(dirname "$0")/.."
source tools/packages.sh
need_packages clang-14 libclang-rt-14-dev

runs=${1:-20000}
shift || true
targets=("$@")
((${#targets[@]} > 0)) || targets=(reader push)
out=build/fuzz
mkdir -p "$out"

flags=(-std=c99 -g -O1 -D_POSIX_C_SOURCE=200809L -ffp-contract=off -Wall -Wextra -Werror -Iinclude -Ilib -Itools/cli
    -fsanitize=fuzzer,address,undefined,float-cast-overflow -fno-sanitize-recover=all)
mapfile -t library < <(find lib -name '*.c' | sort)
reader=(tools/cli/csv.c tools/cli/number.c tools/cli/recording.c)

for target in "${targets[@]}"; do
    sources=("host_tests/fuzz/fuzz_$target.c" "${library[@]}")
    [[ $target == reader ]] && sources+=("${reader[@]}")
    clang-14 "${flags[@]}" "${sources[@]}" -o "$out/fuzz_$target" -lm
    corpus=host_tests/fuzz/corpus/$target
    mkdir -p "$out/$target"
    if [[ $runs == merge ]]; then
        "$out/fuzz_$target" -merge=1 "$corpus" "$out/$target" 2> "$out/$target.log"
        continue
    fi
    count=$runs
    length=8192
    if [[ $target == push ]]; then
        count=$((runs / 100))
        length=2604
    fi
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
