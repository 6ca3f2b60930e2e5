#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds and tests for Cortex-M processors in QEMU: tools/test_target.sh [all | quick | PRESET...]
#
# all (the default): the unit tests on m4f, those without long motions on m3, some on m7 and m33, same bits on host and targets, the
# hub in QEMU, the budget. quick: m4f, hub and budget. PRESET: its tests only; m0 is one, too. These are parts of tools/test.sh,
# which says the rest.
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1:-all} in
-h | --help) sed -n '3,7s/^# //p' "$0" ;;
all) exec tools/test.sh --only m4f m3 m7 m33 bits board budget ;;
quick) exec tools/test.sh --only m4f board budget ;;
*) exec tools/test.sh --only "$@" ;;
esac
