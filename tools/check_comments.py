#!/usr/bin/env python3
"""Fails where a comment breaks a line inside an equation: before or after an operator. Run by ctest.

The formatter reflows comments at its column limit. Equations stand on lines of their own, short enough for that limit; a line
that goes on with the equation of the line before is indented further."""
import re
import subprocess
import sys

COMMENT = re.compile(r"\s*//+(.*)$")
BEGINS = re.compile(r"\s*(?:=|\+|\*|/|<=|>=|·|±) +\S")
ENDS = re.compile(r"\S +(?:=|\+|\*|/|<=|>=|<|>|·|-)\s*$")
# A line of prose may begin with a dash; an equation that goes on has something open before it.
MINUS = re.compile(r"\s*- +\S")


def indent(text):
    return len(text) - len(text.lstrip())


def broken(before, after):
    """Whether an equation goes over from one line of a comment to the next."""
    if indent(after) > indent(before) or not before.strip():
        return False
    going_on = MINUS.match(after) and before.count("(") > before.count(")")
    return bool(BEGINS.match(after) or ENDS.search(before) or going_on)


def main():
    files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "*.h", "*.cc", "*.c"], check=True,
                           capture_output=True, text=True).stdout.split()
    bad = 0
    for file in files:
        lines = [COMMENT.match(line) for line in open(file, encoding="utf-8")]
        for k, (a, b) in enumerate(zip(lines, lines[1:]), 1):
            if a and b and broken(a[1], b[1]):
                print(f"{file}:{k}: an equation is broken: {a[1].strip()[-40:]} | {b[1].strip()[:40]}")
                bad += 1
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
