# SPDX-License-Identifier: MIT
# Sourced by the other scripts: installs what is missing, with apt, and says so.

# need_packages PACKAGE...: installs those that are not there; 1 if that does not work out. Quick if there are none.
need_packages() {
    local missing
    mapfile -t missing < <(missing_packages "$@")
    if ((${#missing[@]} == 0)); then
        return 0
    fi
    if ! can_install; then
        echo "Missing: ${missing[*]}. $(how_to_install "${missing[@]}")" >&2
        return 1
    fi
    install_packages "${missing[@]}"
}

# missing_packages PACKAGE...: prints those that are not there, one per line.
missing_packages() {
    local package
    for package in "$@"; do
        package_present "$package" || echo "$package"
    done
}

# Installing takes apt-get and root.
can_install() {
    command -v apt-get > /dev/null && (($(id -u) == 0))
}

# how_to_install PACKAGE...: prints what the user has to do where this script cannot install.
how_to_install() {
    if command -v apt-get > /dev/null; then
        echo "Please run: sudo apt-get update && sudo apt-get install --yes --no-install-recommends $*"
    else
        echo "Please install them (names of Debian packages); there is no apt-get here."
    fi
}

# install_packages PACKAGE...: as root. The lists are fetched once; where that fails, those that are there may still do.
apt_updated=false
install_packages() {
    echo "Installing $*"
    if ! $apt_updated; then
        apt_updated=true
        apt-get update --quiet > /dev/null || echo "apt-get update failed; going on with the package lists that are there" >&2
    fi
    DEBIAN_FRONTEND=noninteractive apt-get install --yes --quiet --no-install-recommends "$@" > /dev/null
}

# What a package is needed for may be there from another source: then it is not missing.
package_present() {
    case $1 in
    gcc | g++ | cmake | make | pkg-config | python3 | cppcheck | gcovr | clang-14 | clang-format-14 | clang-tidy-14 | qemu-system-arm)
        command -v "$1" > /dev/null
        ;;
    libc6-dev) gcc -E -x c - <<< '#include <stdio.h>' > /dev/null 2>&1 ;;
    xz-utils) command -v xz > /dev/null ;;
    gcc-arm-none-eabi) command -v arm-none-eabi-gcc > /dev/null ;;
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
