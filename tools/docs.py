#!/usr/bin/env python3
"""Figures and tables of the docs, made from the commands that they quote.

A page says how a block of it was made:

    <!-- output of: COMMAND -->
        lines as the command printed them
    <!-- end of output -->

"slow output of" is the same for commands that take more than a few seconds. Commands run in an empty
folder that sees the project's folders scenarios, examples and tools, and `ambrig`. Lines that name
a time of computing are left out. Pictures (docs/figures) are listed in docs/figures/sources.txt.

A page names tests as the source of a figure, `test_FOLDER --gtest_filter=PATTERN`: --check looks in tests/FOLDER
whether there are such tests, because a filter that matches none exits with 0.

  tools/docs.py build/release/ambrig              makes every block and picture (target `docs`)
  tools/docs.py build/release/ambrig --check      compares the cheap ones (ctest docs_blocks)
  tools/docs.py build/release/ambrig --check --slow     all of them (nightly)
"""
import argparse
import difflib
import fnmatch
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"(<!-- (slow )?output of: (.+?) -->\n)(.*?)(<!-- end of output -->)", re.DOTALL)
TIMED = re.compile(r"computed at|\d simulations? in \d|^\s*written")
FILTER = re.compile(r"test_(\w+) --gtest_filter=(?:'([^']*)'|([^\s`]+))")
TEST = re.compile(r"^\s*(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.MULTILINE)
INSTANCE = re.compile(r"INSTANTIATE_(?:TYPED_)?TEST_SUITE_P\(\s*(\w+)\s*,\s*(\w+)\s*,")
SOURCES = PROJECT / "docs/figures/sources.txt"


def folder_of_work(root):
    folder = pathlib.Path(tempfile.mkdtemp(dir=root))
    for name in ("scenarios", "examples", "tools"):
        (folder / name).symlink_to(PROJECT / name)
    return folder


def environment(ambrig):
    return dict(os.environ, PATH=f"{ambrig.parent}:{os.environ['PATH']}", NO_COLOR="1")


def output_of(command, ambrig, root):
    """The block's lines, indented as code."""
    done = subprocess.run(["bash", "-c", command], cwd=folder_of_work(root), text=True,
                          env=environment(ambrig), capture_output=True)
    if done.returncode not in (0, 1) or not done.stdout.strip():
        sys.exit(f"docs: {command}: exit code {done.returncode}: {done.stderr}")
    lines = [line for line in done.stdout.rstrip().split("\n") if not TIMED.search(line)]
    if any(line.startswith("|") for line in lines):  # a table of the page's own
        return "\n" + "\n".join(lines) + "\n\n"
    return "".join(f"    {line}".rstrip() + "\n" for line in lines)


def check_page(page, ambrig, root, options):
    """The page as its commands make it, and how many of its blocks were made."""
    text, made = page.read_text(), 0

    def remade(match):
        nonlocal made
        if match[2] and options.check and not options.slow:
            return match[0]
        made += 1
        return match[1] + output_of(match[3], ambrig, root) + match[5]

    new = BLOCK.sub(remade, text)
    if new == text:
        return True, made
    if not options.check:
        page.write_text(new)
        print(f"docs: {page.relative_to(PROJECT)} made anew")
        return True, made
    name = str(page.relative_to(PROJECT))
    sys.stdout.writelines(difflib.unified_diff(text.splitlines(True), new.splitlines(True),
                                               name, name + " as its commands make it"))
    return False, made


def pictures():
    """[(picture, command, page, width, height)] of docs/figures/sources.txt."""
    rows = []
    for line in SOURCES.read_text().splitlines():
        if line and not line.startswith("#"):
            picture, size, page, command = (part.strip() for part in line.split("|", 3))
            width, height = (int(x) for x in size.split("x"))
            rows.append((picture, command, page, width, height))
    return rows


def check_pictures():
    named = {row[0] for row in pictures()}
    there = {p.name for p in (PROJECT / "docs/figures").glob("*.png")}
    for name in sorted(named ^ there):
        print(f"docs/figures/{name}: " + ("no such picture" if name in named else
                                          "its source is not in sources.txt"))
    return named == there


def make_pictures(ambrig, root):
    if not shutil.which("chromium") or not (PROJECT / "web/node_modules").is_dir():
        print("docs: no chromium or no web/node_modules, pictures are left as they are")
        return
    for picture, command, page, width, height in pictures():
        folder = folder_of_work(root)
        subprocess.run(["bash", "-c", command], cwd=folder, env=environment(ambrig),
                       stdout=subprocess.DEVNULL, check=False)
        subprocess.run(["node", PROJECT / "tools/page_picture.mjs", f"{folder}/{page}",
                        f"{width}x{height}", PROJECT / "docs/figures" / picture], check=True)
        print(f"docs: docs/figures/{picture} made anew")


def pages():
    return [PROJECT / "README.md", PROJECT / "CONTRIBUTING.md", *sorted((PROJECT / "docs").rglob("*.md"))]


def tests_of(folder):
    """Names of the tests of tests/FOLDER as googletest lists them; a parameter counts as its first."""
    text = "\n".join(file.read_text() for file in sorted((PROJECT / "tests" / folder).rglob("*.cc")))
    names = [f"{suite}.{name}" for suite, name in TEST.findall(text)]
    with_parameter = {suite: prefix for prefix, suite in INSTANCE.findall(text)}
    return [f"{with_parameter[name.split('.')[0]]}/{name}/0" if name.split(".")[0] in with_parameter else name
            for name in names]


def check_filters():
    """Whether every pattern of every filter that a page names has a test."""
    right = True
    for page in pages():
        for folder, quoted, plain in FILTER.findall(page.read_text()):
            for pattern in (quoted or plain).split("-")[0].split(":"):
                if not any(fnmatch.fnmatchcase(name, pattern) for name in tests_of(folder)):
                    print(f"{page.relative_to(PROJECT)}: test_{folder} has no test {pattern}")
                    right = False
    return right


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ambrig", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--check", action="store_true", help="change nothing, compare")
    parser.add_argument("--slow", action="store_true", help="with --check: the long ones too")
    parser.add_argument("--only", default="", help="pages whose name holds this")
    options = parser.parse_args()
    same, made = check_pictures() & check_filters(), 0
    with tempfile.TemporaryDirectory(prefix="ambrig_docs_") as root:
        for page in pages():
            if options.only in page.name:
                right, count = check_page(page, options.ambrig, root, options)
                same, made = same and right, made + count
        if not options.check and not options.only:
            make_pictures(options.ambrig, root)
    print(f"docs: {made} blocks made by their commands")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
