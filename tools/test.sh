#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds and tests: tools/test.sh [--all] [--only PART...] [--list] [--help]
set -uo pipefail
cd "$(dirname "$0")/.."
source tools/maintain/packages.sh

usage() {
    cat << 'END'
usage: tools/test.sh               builds and tests for the PC and for one microcontroller, in under 8 minutes on two cores
       tools/test.sh --all         every part; what CI runs; half an hour and more on two cores
       tools/test.sh --only PART...   these parts only
       tools/test.sh --list        the parts, and what each needs

Installs what is missing, as root; otherwise it prints the command that root has to run, and goes on with what is there. A
part that cannot run because a tool or a fetched source is missing is left out, and the last lines say so. A part that fails
does not stop the others. Unit tests that repeat long motions (label long of CTest) run on one microcontroller, m4f, except
those that take minutes there (label longest); m3 leaves all of them out, m7 and m33 also what has nothing of its own on those
processors, and bits compares whole runs of the engines on the PC, m4f and m3 bit by bit. Exit status 1 if a test or a step
failed, 2 for wrong arguments. Log files are in build/logs.

JOINTCAL_DATA   folder with the real recordings (default data/); tests that need them are skipped without.
CI=true         what was not tested for lack of a tool or a fetched source counts as failed. Recordings do not.
END
}

# --- Parts: in the order in which they run ---------------------------------------------------------------------------

short=(host format python generated m4f)
all=(host format python generated tidy cppcheck debug fuzz measure hub m4f m3 m7 m33 bits board budget)
others=(m0) # runs only if it is asked for

declare -A about=(
    [host]="unit tests, tests of the program and of the scripts on the PC"
    [format]="clang-format"
    [python]="tests of simulators, references and measurements"
    [generated]="golden vectors and bundled recordings are what their generators write"
    [tidy]="clang-tidy"
    [cppcheck]="cppcheck"
    [debug]="the tests of host with address and undefined behaviour sanitizers"
    [fuzz]="fuzzers, a short run"
    [measure]="measurements, a short run"
    [hub]="the hub over a bad wire, a short run"
    [m4f]="unit tests on a Cortex-M4F in QEMU"
    [m3]="those without long motions on a Cortex-M3"
    [m7]="those of arithmetic, sensors and hinge on a Cortex-M7"
    [m33]="those of arithmetic, sensors and hinge on a Cortex-M33"
    [m0]="all unit tests as Cortex-M0 code"
    [bits]="same bits on the PC and on microcontrollers"
    [board]="the hub's firmware on emulated boards, beside the PC and over a bad wire"
    [budget]="code, state, stack and instructions on a Cortex-M4F"
)
# Groups of packages; each is installed by itself, so that one that is not to be had leaves the others alone.
declare -A group=(
    [build]="${build_packages[*]}"
    [target]="${target_packages[*]}"
    [numpy]="python3-numpy python3-matplotlib"
    [format]="clang-format-14"
    [tidy]="clang-tidy-14"
    [cppcheck]="cppcheck"
    [fuzz]="clang-14 libclang-rt-14-dev"
    [pkg_config]="pkg-config"
    [fetch]="xz-utils python3-venv"
)
group_order=(build fetch target numpy format tidy cppcheck fuzz pkg_config)
# What a part cannot do without, and what it is better with.
declare -A needs=(
    [host]="build" [format]="build format" [python]="build numpy" [generated]="numpy" [tidy]="build tidy"
    [cppcheck]="build cppcheck" [debug]="build" [fuzz]="fuzz" [measure]="build numpy" [hub]="build numpy" [m4f]="build target"
    [m3]="build target" [m7]="build target" [m33]="build target" [m0]="build target" [bits]="build target"
    [board]="build target numpy" [budget]="build target"
)
declare -A wants=([host]="fetch pkg_config" [debug]="fetch" [measure]="fetch" [m4f]="fetch" [m3]="fetch" [m7]="fetch" [m33]="fetch"
    [m0]="fetch" [bits]="fetch" [budget]="fetch")
# Presets that have to be built before.
declare -A builds=(
    [host]=host [format]=host [python]=host [tidy]=host [cppcheck]=host [debug]=host-debug [measure]=host [hub]=host [m4f]=m4f
    [m3]=m3 [m7]=m7 [m33]=m33 [m0]=m0 [bits]=host [board]="host m4f" [budget]=host
)

part_format() { # Ninja prints the names of all files
    local output
    output=$(cmake --build --preset host --target format_check 2>&1) || {
        cut -c 1-300 <<< "$output"
        return 1
    }
}
part_tidy() { cmake --build --preset host --target tidy; }
part_cppcheck() { cmake --build --preset host --target cppcheck; }
part_host() { # what the part board does too is left to it
    if [[ " ${parts[*]} " == *" board "* ]]; then
        ctest_preset host -LE '^board$'
    else
        ctest_preset host
    fi
}
part_debug() { ctest_preset host-debug; }
part_m4f() { ctest_preset m4f -LE '^longest$'; }
# What differs by processor: arithmetic, and what stands on it most directly.
of_processors='^test_(math|sample|imu|joint|hinge|frame|hub)'
part_m3() { ctest_preset m3 -LE '^long$'; }
part_m7() { ctest_preset m7 -LE '^long$' -R "$of_processors"; }
part_m33() { ctest_preset m33 -LE '^long$' -R "$of_processors"; }
part_m0() { ctest_preset m0; }
part_python() {
    PYTHONPATH=tools/python "$(python_with numpy)" -m unittest discover -s host_tests/python -t host_tests/python -v 2>&1
}
part_generated() {
    local python
    python=$(python_with numpy)
    "$python" tools/maintain/make_golden.py --check
    "$python" tools/maintain/make_demo.py --check
}
part_fuzz() { tools/maintain/fuzz.sh 20000; }
part_measure() { "$(python_with numpy)" tools/measure.py all --quick --no-qmt; }
part_hub() { "$(python_with numpy)" tools/maintain/hub_soak.py --minutes 1; }
part_bits() { tools/same_bits.py --no-write; }
part_board() {
    tools/hub_demo.sh --check
    tools/hub_demo.sh --hinge --check --board stm32f405
    "$(python_with numpy)" tools/maintain/hub_soak.py --minutes 1 --board mps2_an386
}
part_budget() { tools/budget.py --check --no-write; }

ctest_preset() {
    local preset=$1
    shift
    ctest --preset "$preset" -j "$jobs" "$@"
}

# --- Arguments -------------------------------------------------------------------------------------------------------

list_parts() {
    local part
    echo "The short run:"
    for part in "${all[@]}" "${others[@]}"; do
        [[ " ${short[*]} " == *" $part "* ]] && printf '  %-10s %s\n' "$part" "${about[$part]}"
    done
    echo "With --all also:"
    for part in "${all[@]}"; do
        [[ " ${short[*]} " == *" $part "* ]] || printf '  %-10s %s\n' "$part" "${about[$part]}"
    done
    echo "Only if asked for:"
    for part in "${others[@]}"; do
        printf '  %-10s %s\n' "$part" "${about[$part]}"
    done
}

parts=("${short[@]}")
case ${1:-} in
"") ;;
--all) parts=("${all[@]}") && shift ;;
--only)
    shift
    parts=("$@")
    (($# > 0)) || { echo "tools/test.sh: --only needs the name of a part; --list shows them" >&2 && exit 2; }
    shift $#
    ;;
--list) list_parts && exit 0 ;;
-h | --help) usage && exit 0 ;;
*) usage >&2 && exit 2 ;;
esac
(($# == 0)) || { usage >&2 && exit 2; }
for part in "${parts[@]}"; do
    [[ -n ${about[$part]:-} ]] || { echo "tools/test.sh: there is no part '$part'; --list shows them" >&2 && exit 2; }
done

# --- Running ---------------------------------------------------------------------------------------------------------

logs=build/logs
rm -rf "$logs"
mkdir -p "$logs"
jobs=$(nproc 2> /dev/null || echo 2)
strict=false
[[ ${CI:-} == true || ${CI:-} == 1 ]] && strict=true
passed=0 failed=0
failures=() untested=() skips=() summary=()
trap 'echo "Interrupted" >&2; exit 130' INT TERM

step() { printf '\n== %s\n' "$*"; }
# For lack of a tool or a fetched source; what a test itself leaves out (no recordings) goes to skips.
not_tested() { untested+=("$1"); }
fail() { failures+=("$1") && failed=$((failed + ${2:-1})); }

# Runs a command with its output on the terminal and in the log $1; errors end it.
logged() {
    local log=$1
    shift
    (
        set -e
        "$@"
    ) 2>&1 | tee "$log"
    return "${PIPESTATUS[0]}"
}

# Every group that the parts need, once each; missing_group[G] says what could not be had.
declare -A missing_group=()
install_groups() {
    local name part missing wanted=" " to_ask=()
    for part in "${parts[@]}"; do
        wanted+="${needs[$part]} ${wants[$part]:-} "
    done
    for name in "${group_order[@]}"; do
        [[ $wanted == *" $name "* ]] || continue
        # shellcheck disable=SC2086
        mapfile -t missing < <(missing_packages ${group[$name]})
        ((${#missing[@]} > 0)) || continue
        if can_install && install_packages "${missing[@]}"; then
            # shellcheck disable=SC2086
            mapfile -t missing < <(missing_packages ${group[$name]})
        fi
        ((${#missing[@]} > 0)) || continue
        missing_group[$name]=${missing[*]}
        can_install && echo "Not to be had: ${missing[*]}" >&2
        can_install || to_ask+=("${missing[@]}")
    done
    ((${#to_ask[@]} == 0)) || echo "Missing: ${to_ask[*]}. $(how_to_install "${to_ask[@]}")" >&2
}

# Sources that are fetched. Without them the build leaves out what needs them.
fetch_sources() {
    local part wanted=false
    for part in "${parts[@]}"; do
        [[ " ${wants[$part]:-} " == *" fetch "* ]] && wanted=true
    done
    $wanted || return 0
    tools/maintain/unity.sh || echo "Going on without Unity" >&2
    tools/vqf.sh || { echo "Going on without VQF" >&2 && not_tested "what needs VQF: it could not be fetched (tools/vqf.sh)"; }
}

declare -A built=() # preset: yes or no
build_preset() {
    local preset=$1
    [[ -z ${built[$preset]:-} ]] || return 0
    step "Build, preset $preset"
    local began=$SECONDS
    if logged "$logs/configure-$preset.log" cmake --preset "$preset" > /dev/null &&
        logged "$logs/build-$preset.log" cmake --build --preset "$preset" > /dev/null; then
        built[$preset]=yes
        echo "built in $((SECONDS - began)) s"
    else
        built[$preset]=no
        cat "$logs/configure-$preset.log" "$logs/build-$preset.log" 2> /dev/null | tail -n 60
        fail "build of preset $preset (log: $logs/build-$preset.log)"
    fi
    if grep -q 'Unity is not to be had' "$logs/configure-$preset.log"; then
        not_tested "unit tests of preset $preset: Unity could not be fetched (tools/maintain/unity.sh)"
    fi
}

# Adds what CTest or unittest counted in log $2 of part $1, which ended with status $3; other parts count as one.
count_results() {
    local part=$1 log=$2 status=$3 bad=0 good=0 total skipped counted=true verdict number
    # "97% tests passed, 1 tests failed out of 32"; those that were skipped are among those that passed.
    if read -r bad total < <(sed -nE 's/.*tests passed, ([0-9]+) tests failed out of ([0-9]+).*/\1 \2/p' "$log"); then
        skipped=$(grep -c '\*\*\*Skipped' "$log")
        good=$((total - bad - skipped))
        ((skipped == 0)) || skips+=("$part: $(sed -nE 's/.*Test +#[0-9]+: ([^ ]+) .*\*\*\*Skipped.*/\1/p' "$log" | paste -sd ' ')")
    # "Ran 138 tests in 2.1s", then "OK (skipped=3)" or "FAILED (failures=1, errors=2, skipped=3)"
    elif read -r total < <(sed -nE 's/^Ran ([0-9]+) tests? in .*/\1/p' "$log"); then
        verdict=$(grep -E '^(OK|FAILED)' "$log" | tail -n 1)
        bad=0
        while read -r number; do
            bad=$((bad + number))
        done < <(grep -oE '(failures|errors|unexpected successes)=[0-9]+' <<< "$verdict" | sed 's/.*=//')
        skipped=$(sed -nE 's/.*skipped=([0-9]+).*/\1/p' <<< "$verdict")
        good=$((total - bad - ${skipped:-0}))
        ((${skipped:-0} == 0)) || skips+=("$part: $skipped tests that said why in $log")
    else
        bad=0 counted=false
    fi
    if ((status != 0 && bad == 0)); then
        bad=1
    elif ! $counted; then
        good=1
    fi
    passed=$((passed + good))
    ((bad == 0)) || fail "$part (log: $log)" "$bad"
    summary+=("$(printf '%-10s %4d passed, %d failed, %4d s' "$part" "$good" "$bad" "$4")")
}

run_part() {
    local part=$1 name preset log=$logs/$1.log began
    for name in ${needs[$part]}; do
        if [[ $name == build && -n ${missing_group[build]:-} ]]; then
            fail "$part: nothing can be built without ${missing_group[build]}"
            return
        elif [[ -n ${missing_group[$name]:-} ]]; then
            not_tested "$part (${about[$part]}): no ${missing_group[$name]}"
            return
        fi
    done
    # What is fetched with the group fetch may be there already; fetch_sources says if not.
    for name in ${wants[$part]:-}; do
        [[ $name == fetch || -z ${missing_group[$name]:-} ]] || not_tested "$part, some tests: no ${missing_group[$name]}"
    done
    for preset in ${builds[$part]:-}; do
        build_preset "$preset"
        if [[ ${built[$preset]} == no ]]; then
            echo "$part is left out, because the build of $preset failed"
            return
        fi
    done
    step "$part: ${about[$part]}"
    began=$SECONDS
    logged "$log" "part_$part"
    count_results "$part" "$log" $? $((SECONDS - began))
}

step "Tools"
install_groups
fetch_sources
for part in "${parts[@]}"; do
    run_part "$part"
done

step "Results"
[[ -e ${JOINTCAL_DATA:-data}/rig_1D_01.csv ]] ||
    skips+=("tests with real recordings: JOINTCAL_DATA names no folder that holds them")
((${#summary[@]} == 0)) || printf '%s\n' "${summary[@]}"
if ((${#untested[@]} + ${#skips[@]} > 0)); then
    echo "Not tested:"
    printf '  %s\n' "${untested[@]}" "${skips[@]}"
fi
if $strict && ((${#untested[@]} > 0)); then
    fail "what was not tested for lack of a tool or a fetched source, because CI=true" "${#untested[@]}"
fi
if ((${#failures[@]} > 0)); then
    echo "Failed:"
    printf '  %s\n' "${failures[@]}"
fi
echo "$passed passed, $failed failed"
((failed == 0 && passed > 0))
