#!/usr/bin/env python3
"""Lines of test code per line of code, for every folder that has sources, as a Markdown table.

    python3 tools/test_ratio.py [--least 0.35] [--overall 0.5]

Counted are lines of .h and .cc files that hold more than a comment or white space: of FOLDER and of
tests/FOLDER. Tests of several folders (tests/cli, tests/tutorials, bench) count in the total only. With
limits given, exit code 1 when a folder or the total is below its limit.
"""
import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
NOT_CODE = {"tests", "bench", "build", "web", "tools", "docs", "examples", "cmake"}


def code_lines(folder):
    """Lines with code in the .h and .cc files below the folder."""
    count = 0
    for file in sorted(folder.rglob("*")):
        if file.suffix not in (".h", ".cc"):
            continue
        text = re.sub(r"/\*.*?\*/", "", file.read_text(), flags=re.S)
        count += sum(1 for line in text.split("\n") if line.strip() and not line.lstrip().startswith("//"))
    return count


def rows():
    """(folder, lines of code, lines of tests) of every folder with sources."""
    out = []
    for folder in sorted(p for p in ROOT.iterdir() if p.is_dir() and p.name not in NOT_CODE):
        code = 0 if folder.name.startswith(".") else code_lines(folder)
        if code:
            tests = ROOT / "tests" / folder.name
            out.append((folder.name, code, code_lines(tests) if tests.is_dir() else 0))
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--least", type=float, default=0, help="least ratio of every folder")
    parser.add_argument("--overall", type=float, default=0, help="least ratio of the total")
    options = parser.parse_args()
    print("| folder | code | tests | ratio |\n|---|---|---|---|")
    low = []
    table = rows()
    for name, code, tests in table:
        print(f"| `{name}` | {code} | {tests} | {tests / code:.2f} |")
        if tests / code < options.least:
            low.append(name)
    code, tests = sum(r[1] for r in table), code_lines(ROOT / "tests")
    print(f"| all | {code} | {tests} | {tests / code:.2f} |")
    if tests / code < options.overall:
        low.append("all")
    if low:
        print("below the limit:", ", ".join(low), file=sys.stderr)
    return 1 if low else 0


if __name__ == "__main__":
    sys.exit(main())
