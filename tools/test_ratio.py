#!/usr/bin/env python3
"""Lines of test code per line of code, for every folder that has sources, as a Markdown table.

    python3 tools/test_ratio.py [--least 0.35] [--overall 0.5]

Counted are lines that hold more than a comment or white space: of the .h and .cc files of FOLDER and of tests/FOLDER, of
the C++ and Python sources of python/ and of python/tests, of the scripts of the pages (web/) and their tests (tests/web,
and tests/workbench/walk.mjs, which walks through them in Chromium). Tests that start the command (tests/cli,
tests/tutorials) are tests of app/, except those of ELSEWHERE, whose subject is the reader of one kind of file. What
tests/planted adds to a scratch copy is no test of a folder and counts in the total only, as does bench/ nowhere. With
limits given, exit code 1 when a folder or the total is below its limit.
"""
import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Folders of tests, and single files of them, that belong to a folder of another name.
OF_COMMAND = ["cli", "tutorials"]
ELSEWHERE = {
    "cli/rig_messages_test.cc": "rig",
    "cli/bad_inputs/rig_file_test.cc": "rig",
    "cli/scenario_messages_test.cc": "scenarios",
    "cli/bad_inputs/scenario_file_test.cc": "scenarios",
}
NOT_CODE = {"tests", "bench", "build", "tools", "docs", "examples", "cmake", "packaging"}
# Comments of the languages that are counted, and what they comment.
LANGUAGES = {
    (".h", ".cc"): (r"/\*.*?\*/", "//"),
    (".js", ".mjs"): (r"/\*.*?\*/", "//"),
    (".py",): (r'"""(?:.|\n)*?"""', "#"),
}


def code_lines(folder, leave_out=()):
    """Lines with code in the sources below the folder, or of one file."""
    count = 0
    for file in [folder] if folder.is_file() else sorted(folder.rglob("*")):
        if file in leave_out or "node_modules" in file.parts:
            continue
        if file.suffix == ".py" and "python" not in file.relative_to(ROOT).parts:
            continue  # what wrote a file of test data
        for suffixes, (block, line_comment) in LANGUAGES.items():
            if file.suffix in suffixes:
                text = re.sub(block, "", file.read_text(), flags=re.S)
                count += sum(1 for line in text.split("\n") if line.strip() and not line.lstrip().startswith(line_comment))
    return count


def tests_of(name):
    """Folders and files of the tests of the folder of this name."""
    tests = ROOT / "tests"
    if name == "python":
        return [ROOT / "python" / "tests"]
    if name == "web":
        return [tests / "web", tests / "workbench" / "walk.mjs"]
    return [tests / name, *(tests / other for other in OF_COMMAND if name == "app"),
            *(tests / file for file, folder in ELSEWHERE.items() if folder == name)]


def test_lines(name):
    """Lines of the tests of the folder of this name."""
    foreign = {ROOT / "tests" / file for file, folder in ELSEWHERE.items() if folder != name}
    foreign |= {ROOT / "tests" / "workbench" / "walk.mjs"} if name == "workbench" else set()
    return sum(code_lines(place, foreign) for place in tests_of(name))


def rows():
    """(folder, lines of code, lines of tests) of every folder with sources."""
    out = []
    for folder in sorted(p for p in ROOT.iterdir() if p.is_dir() and p.name not in NOT_CODE):
        code = 0 if folder.name.startswith(".") else code_lines(folder, set((ROOT / "python" / "tests").rglob("*")))
        if code:
            out.append((folder.name, code, test_lines(folder.name)))
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
    code, tests = sum(r[1] for r in table), code_lines(ROOT / "tests") + code_lines(ROOT / "python" / "tests")
    print(f"| all | {code} | {tests} | {tests / code:.2f} |")
    if tests / code < options.overall:
        low.append("all")
    if low:
        print("below the limit:", ", ".join(low), file=sys.stderr)
    return 1 if low else 0


if __name__ == "__main__":
    sys.exit(main())
