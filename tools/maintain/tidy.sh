#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs clang-tidy over files in parallel and prints findings only. usage: tidy.sh CLANG_TIDY BUILD JOBS FILE...
set -euo pipefail
tidy=$1 build=$2 jobs=$3
shift 3
# "N warnings generated" counts what the configuration then leaves out.
printf '%s\0' "$@" | xargs -0 -n 2 -P "$jobs" "$tidy" -p "$build" --quiet 2> >(grep -v ' warnings\? generated' >&2)
