#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the tests of the program: test_program.py [PROGRAM]. What it promises is spread over test_*.py beside this file."""
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True

if __name__ == "__main__":
    folder = str(pathlib.Path(__file__).resolve().parent)
    suite = unittest.TestSuite(unittest.defaultTestLoader.discover(folder, pattern=f"test_{name}.py")
                               for name in ("refused", "words", "accepted", "output", "two_files", "angles", "two_dof", "ball", "center", "chain"))
    sys.exit(not unittest.TextTestRunner().run(suite).wasSuccessful())
