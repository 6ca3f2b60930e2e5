# SPDX-License-Identifier: MIT
# Sourced by the other scripts: installs what is missing, with apt, and says so.

# need_packages PACKAGE...: installs those that are not there. Quick if there are none.
need_packages() {
    local missing=() package
    for package in "$@"; do
        if ! package_present "$package"; then
            missing+=("$package")
        fi
    done
    if ((${#missing[@]} == 0)); then
        return 0
    fi
    local install=(apt-get install --yes --quiet --no-install-recommends "${missing[@]}")
    if ! command -v apt-get > /dev/null; then
        echo "Missing: ${missing[*]} (names of Debian packages). Please install them; there is no apt-get here." >&2
        return 1
    fi
    if ((EUID != 0)); then
        echo "Missing: ${missing[*]}. Please run: sudo apt-get update && sudo ${install[*]}" >&2
        return 1
    fi
    echo "Installing ${missing[*]}"
    export DEBIAN_FRONTEND=noninteractive
    apt-get update --quiet > /dev/null && "${install[@]}" > /dev/null
}

# What a package is needed for may be there from another source: then it is not missing.
package_present() {
    case $1 in
    gcc | g++ | cmake | make | pkg-config | python3 | xz-utils)
        command -v "${1%-utils}" > /dev/null
        ;;
    python3-numpy | python3-matplotlib) python_with "${1#python3-}" > /dev/null ;;
    *) dpkg-query --show --showformat '${db:Status-Status}' "$1" 2> /dev/null | grep -qx installed ;;
    esac
}

# python_with MODULE...: prints a python3 that can import all of them. The system's own, which Debian's packages serve,
# need not be the first in PATH.
python_with() {
    local python
    for python in /usr/bin/python3 python3; do
        if command -v "$python" > /dev/null && "$python" -c "$(printf 'import %s\n' "$@")" 2> /dev/null; then
            echo "$python"
            return 0
        fi
    done
    return 1
}

# The host build needs these.
build_packages=(gcc g++ libc6-dev cmake make python3)
# And this what is built for microcontrollers and run in QEMU.
target_packages=(gcc-arm-none-eabi picolibc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm libstdc++-arm-none-eabi-picolibc)
