#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs a firmware image in QEMU with semihosting and passes its exit status on: run_qemu.sh MACHINE IMAGE
# 124 means that it took longer than QEMU_SECONDS (default 280).
exec timeout --kill-after=5 "${QEMU_SECONDS:-280}" qemu-system-arm -M "$1" -display none -monitor none -serial none \
    -chardev stdio,id=sh -semihosting-config enable=on,target=native,chardev=sh -kernel "$2" < /dev/null
