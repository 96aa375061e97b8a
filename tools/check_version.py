#!/usr/bin/env python3
"""Fails where a file states another version than CMakeLists.txt. Run by ctest.

The program takes its version from there (core/base/version.cc.in), its manual pages take it from the program; the files below
are read by tools that cannot."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
STATED = {"CITATION.cff": r"^version: (\S+)$", "python/ambrig/__init__.py": r'^__version__ = "(\S+)"$'}


def stated(file, pattern):
    found = re.search(pattern, (ROOT / file).read_text(), re.M)
    return found[1] if found else "none"


def main():
    version = stated("CMakeLists.txt", r"^project\(ambrig VERSION (\S+) ")
    bad = [f"{file}: version {stated(file, pattern)}, allowed: {version}, that of CMakeLists.txt"
           for file, pattern in STATED.items() if stated(file, pattern) != version]
    print("\n".join(bad))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
