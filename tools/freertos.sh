#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Puts the FreeRTOS kernel (MIT) into build/freertos and prints that folder; with JOINTCAL_FREERTOS_ROOT, the folder of a kernel's source
# that is there already, checks that one and prints it. Quick the second time.
#
# Release V11.1.0, from its public repository with curl or git. The files that are used are pinned: the SHA-256 below is that of their list
# of SHA-256.
set -euo pipefail
cd "$(dirname "$0")/.."

release=V11.1.0
repository=https://github.com/FreeRTOS/FreeRTOS-Kernel
files=(tasks.c list.c include/{FreeRTOS,deprecated_definitions,list,mpu_wrappers,portable,projdefs,stack_macros,task,timers}.h
    portable/GCC/ARM_CM4F/{port.c,portmacro.h})
list_sha256=6a83ca8746767b739be2fdb310d4f81967d3f061be1cd11ffc39869904476f01

# The files in folder $1 are the pinned ones.
right_files() {
    [[ $( (cd "$1" && sha256sum "${files[@]}") 2> /dev/null | sha256sum) == "$list_sha256  -" ]]
}

target=build/freertos
if [[ -n ${JOINTCAL_FREERTOS_ROOT:-} ]]; then
    right_files "$JOINTCAL_FREERTOS_ROOT" ||
        echo "$JOINTCAL_FREERTOS_ROOT is not FreeRTOS-Kernel $release, with which the demo was tried" >&2
    realpath "$JOINTCAL_FREERTOS_ROOT"
    exit 0
fi
if ! right_files "$target"; then
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    echo "Fetching FreeRTOS-Kernel $release into $target" >&2
    mkdir -p "$work/unpacked"
    { curl --fail --silent --location --max-time 120 "$repository/archive/refs/tags/$release.tar.gz" -o "$work/kernel.tar.gz" &&
        tar -xzf "$work/kernel.tar.gz" -C "$work/unpacked" --strip-components=1; } ||
        timeout 300 git clone --quiet --depth 1 --branch "$release" "$repository" "$work/unpacked" 2> /dev/null || true
    if ! right_files "$work/unpacked"; then
        echo "FreeRTOS is not to be had: set JOINTCAL_FREERTOS_ROOT to a folder with FreeRTOS-Kernel $release" >&2
        exit 1
    fi
    rm -rf "$target"
    for file in "${files[@]}"; do
        install -D -m 644 "$work/unpacked/$file" "$target/$file"
    done
fi
realpath "$target"
