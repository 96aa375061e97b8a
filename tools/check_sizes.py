#!/usr/bin/env python3
"""Fails when a source file or a function is too long to be read in one piece. Run by ctest.

    tools/check_sizes.py [FOLDER ...]        default: every folder of sources, and scripts wherever they are

A function is counted from the line on which its signature begins to its closing brace, TEST bodies included. Comments,
strings and preprocessor lines are removed before braces are counted, so the scan needs no compiler. Of scripts (Python,
JavaScript, C, shell, CMake) the files are counted, of Python the functions too."""
import ast
import os
import pathlib
import re
import sys

MOST_FILE_LINES = 300
MOST_FUNCTION_LINES = 60
FOLDERS = ["core", "actuators", "rotor", "control", "effects", "rig", "fdd", "faulttolerance", "scenarios", "simulation",
           "analysis", "discovery", "campaign", "design", "fmu", "workbench", "app", "bench", "tests"]
# What is still longer, and why: (file, function). Remove a line as soon as its function is short enough.
REMAINING = {("tools/random_scenarios.py", "")}  # is being split
# Scripts, with those of tests and tools; what npm installs and what is built is not ours.
SCRIPTS = (".py", ".js", ".mjs", ".c", ".sh", ".cmake")
NOT_OURS = {"node_modules", "build", ".git", "__pycache__"}
# A brace after one of these opens no function.
SCOPES = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b")


def without_text(source):
    """The source with comments, literals and preprocessor lines blanked; line breaks stay."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match[0])
    source = re.sub(r'R"(\w*)\((?:.|\n)*?\)\1"', blank, source)
    source = re.sub(r"//[^\n]*|/\*(?:.|\n)*?\*/|\"(?:\\.|[^\"\\\n])*\"|(?<![\w])'(?:\\.|[^'\\\n])+'", blank, source)
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, source, flags=re.M)


def opens_function(head):
    """Whether the text before a brace is a function's signature, at namespace or class level."""
    if "(" not in head:
        return False
    before = head.split("(", 1)[0]
    if SCOPES.search(re.sub(r"<[^<>]*>", "", before)):
        return False
    # Initialisers `Type name = {...}` and `std::vector<...> name{f(x)}` have the brace behind = or an identifier.
    return "=" not in re.sub(r"operator\s*[=!<>+\-*/]*=|[<>!=]=|\[=\]", "", before)


def functions(source):
    """(line of the signature, name, lines) of every function."""
    text = without_text(source)
    out = []
    scopes = []  # open braces outside functions
    head_begin = 0
    k = 0
    while k < len(text):
        ch = text[k]
        if ch == ";" or ch == "}":
            head_begin = k + 1
        if ch == "}" and scopes:
            scopes.pop()
        if ch == "{":
            head = text[head_begin:k]
            if opens_function(head):
                end = matching(text, k)
                end = end_of_initialisers(text, end)
                begin = head_begin + len(head) - len(head.lstrip())
                begin = skip_access(text, begin)
                first, last = text.count("\n", 0, begin) + 1, text.count("\n", 0, end) + 1
                out.append((first, name_of(head), last - first + 1))
                k = end
            else:
                scopes.append(k)
            head_begin = k + 1
        k += 1
    return out


def skip_access(text, begin):
    match = re.compile(r"(?:(?:public|private|protected)\s*:\s*)+").match(text, begin)
    return match.end() if match else begin


def matching(text, begin):
    depth = 0
    for k in range(begin, len(text)):
        depth += (text[k] == "{") - (text[k] == "}")
        if depth == 0:
            return k
    return len(text) - 1


def end_of_initialisers(text, end):
    """A constructor's initialisers may have braces of their own: goes on to its body."""
    while True:
        match = re.compile(r"\s*(?:,[^;{}]*)?\{").match(text, end + 1)
        if not match:
            return end
        end = matching(text, match.end() - 1)


def name_of(head):
    match = re.search(r"([\w:~]+(?:\s*operator\s*\S+)?)\s*\(([^()]*)", head)
    if not match:
        return "?"
    if match[1].startswith(("TEST", "BENCHMARK")):
        return f"{match[1]}({' '.join(match[2].split())})"
    return match[1]


def scripts():
    """Every script of the project."""
    for folder, folders, files in os.walk("."):
        folders[:] = sorted(f for f in folders if f not in NOT_OURS)
        yield from (pathlib.Path(folder, f) for f in sorted(files) if f.endswith(SCRIPTS))


def long_script(file):
    """What is too long in a script."""
    source = file.read_text()
    lines, out = source.count("\n"), []
    if lines > MOST_FILE_LINES:
        out.append(f"{file}: {lines} lines, at most {MOST_FILE_LINES}")
    if file.suffix == ".py":
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, ast.FunctionDef) and node.end_lineno - node.lineno + 1 > MOST_FUNCTION_LINES:
                out.append(f"{file}:{node.lineno}: {node.name} has {node.end_lineno - node.lineno + 1} lines, "
                           f"at most {MOST_FUNCTION_LINES}")
    return [line for line in out if (file.as_posix(), "") not in REMAINING]


def main():
    bad = []
    if len(sys.argv) == 1:
        for file in scripts():
            bad += long_script(file)
    for folder in sys.argv[1:] or FOLDERS:
        for file in sorted(path for ending in ("*.h", "*.cc") for path in pathlib.Path(folder).rglob(ending)):
            source = file.read_text()
            lines = source.count("\n")
            if lines > MOST_FILE_LINES:
                bad.append(f"{file}: {lines} lines, at most {MOST_FILE_LINES}")
            bad += [f"{file}:{line}: {name} has {length} lines, at most {MOST_FUNCTION_LINES}"
                    for line, name, length in functions(source)
                    if length > MOST_FUNCTION_LINES and (file.as_posix(), name) not in REMAINING]
    print("\n".join(bad))
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
