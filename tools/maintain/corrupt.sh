#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Corrupts the memory of running estimators: tools/maintain/corrupt.sh [COUNT]
#
# COUNT corruptions (default 10000) of the state of each under address and undefined behaviour sanitizers (host_tests/fuzz/corrupt.c); 10000
# and more write docs/measurements/corruptions.md. `build/fuzz/corrupt --one NAME NUMBER` repeats one that broke something.
set -euo pipefail
cd "$(dirname "$0")/../.."
count=${1:-10000}
report=build/fuzz/corruptions.md
((count >= 10000)) && report=docs/measurements/corruptions.md
status=0
CORRUPTIONS=$count tools/maintain/fuzz.sh 0 corrupt || status=1
{
    printf '# Corrupted memory\n\nWritten by `tools/maintain/corrupt.sh %s`, under address and undefined behaviour sanitizers.\n\n' "$count"
    printf 'One to three times in the state of an estimator that has run for 0.5, 7, 20 or 47 s a bit is turned, or a byte or a word becomes any number, or a word all\n'
    printf 'zeros, all ones, NaN, infinite, the largest or the smallest. It then runs on for 3 s. Broken: it crashed, read or wrote out of its\n'
    printf 'arrays, did what C does not define, or took more than 5 s.\n\n'
    printf 'Left alone are what the caller handed over and nothing can be checked against: the table of a body, storage and settings of packets, the flash of a writer. A\n'
    printf 'bool that is neither 0 nor 1 is undefined in C; what comes of it is looked at, that alone is not counted. What an estimator says\n'
    printf 'after it is worth nothing.\n\n'
    printf '| state | bytes | corruptions | broken |\n| --- | --- | --- | --- |\n'
    cat build/fuzz/corrupt.txt
} > "$report"
cat build/fuzz/corrupt.txt
exit "$status"
