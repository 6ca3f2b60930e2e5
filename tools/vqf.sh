#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Puts VQF (orientation filter by Laidig and Seel, MIT) into build/vqf, where the build looks for it. Quick the second time.
#
# The source is that of the Python package vqf; archive and files are pinned by SHA-256.
set -euo pipefail
cd "$(dirname "$0")/.."

package=vqf==2.1.2
archive=vqf-2.1.2.tar.gz
archive_sha256=2bf7134ffb181d518ac8c0855a239881c5a3e06e927605c351e72bbce1623233
cpp_sha256=fb035248ebeccc16897476c7afca5e912f3ad77f0faebd16ff4d5f94b44c614b
hpp_sha256=ef15c074bce16adb76e7f191970ea589bc6d7ce01027130e5233041c0e11eb24

target=build/vqf
# The files in folder $1 are the pinned ones.
right_files() {
    printf '%s  %s\n' "$cpp_sha256" "$1/vqf.cpp" "$hpp_sha256" "$1/vqf.hpp" | sha256sum --status --check - 2> /dev/null
}

if right_files "$target"; then
    exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

echo "Fetching VQF into $target"
# pip asks the package itself for its metadata, for which it fetches the package's build tools into a folder of its own.
echo "$package --hash=sha256:$archive_sha256" > "$work/requirements.txt"
mkdir -p "$work/unpacked"
if ! python3 -m venv "$work/venv" ||
    ! "$work/venv/bin/pip" --quiet --disable-pip-version-check download --no-deps --no-binary vqf --require-hashes \
        -r "$work/requirements.txt" -d "$work" ||
    ! echo "$archive_sha256  $work/$archive" | sha256sum --quiet --check - ||
    ! tar -xzf "$work/$archive" -C "$work/unpacked" --strip-components=3 --wildcards '*/vqf/cpp/vqf.[ch]pp' ||
    ! right_files "$work/unpacked"; then
    echo "VQF is not to be had: put vqf.cpp and vqf.hpp into $target or set JOINTCAL_VQF_ROOT" >&2
    exit 1
fi
mkdir -p "$target"
cp "$work/unpacked/vqf.cpp" "$work/unpacked/vqf.hpp" "$target/"
