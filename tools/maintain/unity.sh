#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Puts Unity (the C test framework) into build/unity, where host_tests/unity.cmake looks for it. Quick the second time.
#
# No distribution packages it by itself. First choice is Debian's and Ubuntu's source package ntpsec, which contains it,
# read with a private apt configuration so that the system's own stays as it is. Second choice is a source release on PyPI.
# Both are pinned by SHA-256.
set -euo pipefail
cd "$(dirname "$0")/../.."

ntpsec_tar=ntpsec_1.2.2+dfsg1.orig.tar.xz
ntpsec_sha256=53e527e3d04d551d41af2d359c2715c2de5f5bfa2a695d4ec1a811b3e9137f63
pypi_package=cryptoauthlib==20260505
pypi_sha256=34ced301cfba7e58b13f6a423d9afa520c0bd28f6ec933ce79bb37c1ca558fc7

target=build/unity
if [[ -e $target/unity.c && -e $target/unity.h && -e $target/unity_internals.h ]]; then
    exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The mirror is that of the machine's own sources: one deb-src line for every archive that apt already uses, but those for
# security updates, which are not mirrored everywhere.
source_lines() {
    apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' | sort -u |
        sed -nE '/-security /d; s/^(.* (main|universe))$/deb-src \1/p'
}

from_apt() {
    command -v apt-get > /dev/null && command -v xz > /dev/null || return 1
    mkdir -p "$work"/{lists/partial,cache/archives/partial,parts,apt}
    source_lines > "$work/sources.list" || return 1
    local apt=(apt-get -qq -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts="$work/parts"
        -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work/cache" -o APT::Sandbox::User=root)
    "${apt[@]}" update || return 1
    (cd "$work/apt" && "${apt[@]}" source --download-only --only-source ntpsec) > /dev/null || return 1
    echo "$ntpsec_sha256  $work/apt/$ntpsec_tar" | sha256sum --quiet --check - || return 1
    tar -xJf "$work/apt/$ntpsec_tar" -C "$target" --strip-components=3 --wildcards '*/tests/unity/unity*.[ch]'
}

from_pypi() {
    python3 -m venv "$work/venv" || return 1
    "$work/venv/bin/pip" --quiet install setuptools wheel || return 1
    echo "$pypi_package --hash=sha256:$pypi_sha256" > "$work/requirements.txt"
    "$work/venv/bin/pip" --quiet download --no-deps --no-binary :all: --no-build-isolation --require-hashes \
        -r "$work/requirements.txt" -d "$work/pypi" || return 1
    tar -xzf "$work"/pypi/*.tar.gz -C "$target" --strip-components=3 --wildcards '*/third_party/unity/unity*.[ch]'
}

echo "Fetching Unity into $target"
mkdir -p "$target"
if ! from_apt; then
    echo "The source package of ntpsec did not work out; trying PyPI"
    from_pypi || { echo "Unity is not to be had: put its sources into $target or set UNITY_ROOT" >&2; exit 1; }
fi
