#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""tools/test.sh goes on where something is missing, says so, and counts: run in a copy of its folder with commands that only
pretend.

usage: test_test_sh.py
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ("tools/test.sh", "tools/test_target.sh", "tools/maintain/packages.sh", ".ci/run")
REAL = ("bash", "env", "dirname", "cat", "cut", "grep", "sed", "tee", "tail", "head", "mkdir", "rm", "nproc", "paste", "cp")
# Stands for every command that is not real. FAILS names what fails.
STUB = """#!/bin/bash
for broken in $FAILS; do
    [[ $broken == "${0##*/}" ]] && fail=yes
done
"""
CTEST = STUB + """
echo "$*" >> "$TREE/ctest.log"
[[ $* == *"--preset host "* && $FAILS == *ctest:host* ]] && fail=yes
if [[ -n $fail ]]; then
    printf ' 4/10 Test  #4: test_d .....***Failed    0.1 sec\\n\\n70%% tests passed, 3 tests failed out of 10\\n'
    exit 8
fi
printf '100%% tests passed, 0 tests failed out of 10\\n\\n 4/10 Test  #4: test_d .....***Skipped   0.1 sec\\n'
"""
CMAKE = STUB + """
[[ $* == *--build*host && $FAILS == *build:host* ]] && echo "error: a.c" && exit 1
[[ $* == *format_check && $FAILS == *format_check* ]] && echo "a.c: style" && exit 1
[[ $* != *--build* && $FAILS == *unity.sh* ]] && echo "Unity is not to be had: no unit tests."
exit 0
"""
APT = STUB + """
echo "$*" >> "$TREE/apt.log"
[[ -z $fail ]] || { echo "E: no network" >&2; exit 100; }
for word; do
    [[ $1 == install && " $LACKS " != *" $word "* ]] && echo "$word" >> "$TREE/installed" && cp "$TREE/bin/true" "$TREE/bin/$word"
done
exit 0
"""
DPKG = """#!/bin/bash
[[ " $MISSING $LACKS " == *" ${!#} "* ]] && ! grep -qx "${!#}" "$TREE/installed" 2> /dev/null && exit 1
echo installed
"""
ID = """#!/bin/bash
echo "${USER_ID:-0}"
"""
PYTHON = f"""#!/bin/bash
[[ $1 == -c ]] || exec {sys.executable} "$@"
"""
PLAIN = STUB + '[[ -z $fail ]] || { echo "${0##*/} does not work out" >&2; exit 1; }\n'
TOOLS = ("gcc", "g++", "make", "pkg-config", "xz", "cppcheck", "clang-14", "clang-format-14", "clang-tidy-14", "arm-none-eabi-gcc",
         "qemu-system-arm", "true")
SHELL_STUBS = ("tools/maintain/unity.sh", "tools/vqf.sh", "tools/maintain/fuzz.sh", "tools/hub_demo.sh")
PYTHON_STUBS = ("tools/maintain/make_golden.py", "tools/maintain/make_demo.py", "tools/measure.py", "tools/maintain/hub_soak.py",
                "tools/same_bits.py", "tools/budget.py")
TEST = "import unittest\n\n\nclass T(unittest.TestCase):\n    def test_a(self):\n        {}\n\n    def test_b(self):\n        pass\n"


class TestScript(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = pathlib.Path(folder.name)
        self.bin = self.tree / "bin"
        self.bin.mkdir()
        for name in SCRIPTS:
            (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.tree / name)
        for name in REAL:
            (self.bin / name).symlink_to(shutil.which(name))
        for name in TOOLS:
            self.write(f"bin/{name}", PLAIN)
        for name, text in {"cmake": CMAKE, "ctest": CTEST, "apt-get": APT, "dpkg-query": DPKG, "id": ID, "python3": PYTHON}.items():
            self.write(f"bin/{name}", text)
        for name in SHELL_STUBS:
            self.write(name, PLAIN)
        for name in PYTHON_STUBS:
            self.write(name, f"#!{sys.executable}\n")
        self.write("host_tests/python/test_t.py", TEST.format("pass"))

    def write(self, name, text):
        path = self.tree / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def run_script(self, *arguments, script="tools/test.sh", gone=(), **environment):
        for name in gone:
            (self.bin / name).unlink()
        result = subprocess.run([self.tree / script, *arguments], capture_output=True, text=True, timeout=60, check=False,
                                env={"PATH": str(self.bin), "TREE": str(self.tree), "JOINTCAL_DATA": str(self.tree), **environment})
        self.output = result.stdout + result.stderr
        lines = result.stdout.splitlines()
        self.last = lines[-1] if lines else ""
        untested = result.stdout.partition("Not tested:\n")[2].splitlines()
        self.untested = "\n".join(line for line in untested if line.startswith("  "))
        return result.returncode

    def test_all_is_well(self):
        # 2 runs of CTest with one of ten skipped, two Python tests, format, generated.
        self.assertEqual(self.run_script(), 0, self.output)
        self.assertEqual(self.last, "22 passed, 0 failed")
        self.assertIn("host: test_d", self.untested)
        self.assertFalse((self.tree / "apt.log").exists())
        self.assertEqual(self.run_script("--all", CI="true"), 0, self.output)
        # Six runs of CTest, two Python tests, and format, generated, tidy, cppcheck, fuzz, measure, hub, bits, board, budget.
        self.assertEqual(self.last, "66 passed, 0 failed")

    def test_a_failing_test_or_step_fails_and_the_rest_goes_on(self):
        for fails, last in (("ctest:host", "20 passed, 3 failed"), ("format_check", "21 passed, 1 failed")):
            self.assertEqual(self.run_script(FAILS=fails), 1, self.output)
            self.assertEqual(self.last, last, self.output)
        self.write("host_tests/python/test_t.py", TEST.format("self.fail()"))
        self.assertEqual(self.run_script(), 1)
        self.assertEqual(self.last, "21 passed, 1 failed", self.output)
        self.write("tools/maintain/make_golden.py", f"#!{sys.executable}\nraise SystemExit(1)\n")
        self.assertEqual(self.run_script(), 1)
        self.assertEqual(self.last, "20 passed, 2 failed", self.output)

    def test_a_runner_that_dies_without_a_count_fails(self):
        self.write("bin/ctest", "#!/bin/bash\nexit 1\n")
        self.assertEqual(self.run_script("--only", "host"), 1)
        self.assertEqual(self.last, "0 passed, 1 failed")

    def test_a_failing_build_leaves_out_what_needs_it(self):
        self.assertEqual(self.run_script(FAILS="build:host"), 1)
        self.assertEqual(self.last, "10 passed, 1 failed", self.output)
        self.assertIn("error: a.c", self.output)

    def test_what_apt_lacks_is_left_out_by_name(self):
        lacks = {"gone": ["clang-format-14", "qemu-system-arm"], "LACKS": "clang-format-14 qemu-system-arm"}
        self.assertEqual(self.run_script(**lacks), 0, self.output)
        self.assertEqual(self.last, "12 passed, 0 failed")
        self.assertIn("format (clang-format): no clang-format-14", self.untested)
        self.assertIn("no qemu-system-arm", self.untested)
        # One group at a time: what is to be had is there in spite of it.
        self.assertIn("clang-format-14\n", (self.tree / "apt.log").read_text())
        self.assertEqual(self.run_script("--all", CI="true", LACKS=lacks["LACKS"]), 1)
        self.assertRegex(self.last, "passed, [1-9][0-9]* failed")
        self.assertIn("because CI=true", self.output)

    def test_a_missing_package_is_installed(self):
        self.assertEqual(self.run_script(gone=["cppcheck", "clang-tidy-14"], MISSING="libclang-rt-14-dev"), 0)
        self.assertFalse((self.tree / "apt.log").exists(), "the short run needs none of them")
        self.assertEqual(self.run_script("--only", "cppcheck", "tidy", "fuzz", MISSING="libclang-rt-14-dev"), 0, self.output)
        self.assertEqual(self.last, "3 passed, 0 failed")
        installs = [line.split()[-1] for line in (self.tree / "apt.log").read_text().splitlines() if line.startswith("install")]
        self.assertEqual(installs, ["clang-tidy-14", "cppcheck", "libclang-rt-14-dev"])

    def test_without_network_it_goes_on_with_what_there_is(self):
        self.assertEqual(self.run_script(gone=["clang-format-14"], FAILS="apt-get unity.sh vqf.sh"), 0, self.output)
        self.assertIn("E: no network", self.output)
        for text in ("format (clang-format)", "unit tests of preset host: Unity", "unit tests of preset m4f: Unity", "needs VQF"):
            self.assertIn(text, self.untested)
        self.assertEqual(self.last, "21 passed, 0 failed")
        self.assertEqual(self.run_script(FAILS="apt-get unity.sh vqf.sh", CI="true"), 1)
        self.assertEqual(self.last, "21 passed, 4 failed", self.output)

    def test_who_is_not_root_is_told_what_to_install(self):
        self.assertEqual(self.run_script(gone=["clang-format-14", "pkg-config"], USER_ID="1000"), 0, self.output)
        self.assertIn("sudo apt-get install --yes --no-install-recommends clang-format-14 pkg-config", self.output)
        self.assertIn("format (clang-format)", self.untested)
        self.assertIn("host, some tests: no pkg-config", self.untested)
        self.assertFalse((self.tree / "apt.log").exists())
        self.assertEqual(self.run_script(gone=["apt-get"]), 0)
        self.assertIn("there is no apt-get here", self.output)

    def test_without_a_compiler_it_fails(self):
        self.assertEqual(self.run_script(gone=["g++"], FAILS="apt-get"), 1)
        self.assertIn("nothing can be built without g++", self.output)

    def test_parts(self):
        self.assertEqual(self.run_script("--only", "format"), 0)
        self.assertEqual(self.last, "1 passed, 0 failed")
        self.assertEqual(self.run_script("quick", script="tools/test_target.sh"), 0, self.output)
        self.assertEqual(self.last, "11 passed, 0 failed")
        self.assertEqual(self.run_script("m0", script="tools/test_target.sh"), 0)
        self.assertEqual(self.last, "9 passed, 0 failed")
        for wrong in (["--only"], ["--only", "formats"], ["--fast"], ["--all", "format"]):
            self.assertEqual(self.run_script(*wrong), 2, wrong)
        self.assertEqual(self.run_script("--help"), 0)
        self.assertIn("usage: tools/test.sh", self.output)
        self.assertEqual(self.run_script("--list"), 0)
        self.assertIn("clang-tidy", self.output)

    def test_long_motions_run_on_one_microcontroller(self):
        self.assertEqual(self.run_script("--only", "host", "m4f", "m3", "m7", "m33", "m0"), 0, self.output)
        calls = [line.split() for line in (self.tree / "ctest.log").read_text().splitlines()]
        without = {call[call.index("--preset") + 1]: call[call.index("-LE") + 1] for call in calls if "-LE" in call}
        self.assertEqual(without, {"m4f": "^longest$", "m3": "^long$", "m7": "^long$", "m33": "^long$"})
        self.assertEqual(len(calls), 6)

    def test_ci_runs_all_and_is_strict(self):
        self.assertEqual(self.run_script(script=".ci/run"), 0, self.output)
        self.assertEqual(self.last, "66 passed, 0 failed")
        self.assertEqual(self.run_script(script=".ci/run", FAILS="vqf.sh"), 1)
        self.assertEqual(self.last, "66 passed, 1 failed")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
