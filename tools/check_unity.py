#!/usr/bin/env python3
"""Names that a unity build would see twice. Run by ctest.

    tools/check_unity.py

With AMBRIG_UNITY several sources of a folder are compiled as one (cmake/folders.cmake). A name of an unnamed namespace that
stands in two sources of a folder then does not compile or, worse, overloads: each must be unique in its folder.
"""
import collections
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Compiled one by one, as cmake/folders.cmake and CMakeLists.txt say.
APART = re.compile(r"^(actuators|bench)/|catalogue\.cc$|^core/math/(noise_\w+|cvode|kinsol)\.cc$"
                   r"|/(ode_world|nlopt_search|program_search)\.cc$|^discovery/search/fit\.cc$")
DECLARATION = [
    re.compile(r"^(?:struct|class|enum class|enum|union) (\w+)(?!;)\b(?=.*[{:]|$)"),
    re.compile(r"^(?:inline |static )*(?:constexpr|const) [^=({]*?(\w+)(?:\[\w*\])*\s*(?:=|\{)"),
    re.compile(r"^[A-Za-z_\[][^=;{}]*?[\s&*>](\w+)\((?!.*\)\s*;$)"),
]


def folder_of(name):
    if name.startswith("analysis/linear/"):
        return "analysis/linear"
    return "/".join(name.split("/")[:2 if name.startswith("tests/") else 1])


def names_of(text):
    """Names declared at the outermost level of the unnamed namespaces (clang-format leaves them in the first column).

    An alias may be said again: the compiler sees whether it is the same.
    """
    inside, names = False, set()
    for line in text.splitlines():
        if line == "namespace {":
            inside = True
        elif line.startswith("}  // namespace") and line.strip() == "}  // namespace":
            inside = False
        elif inside and line[:1] not in ("", " ", "/", "}", "#") and not line.startswith(("template", "using ")):
            for form in DECLARATION:
                match = form.match(line)
                if match:
                    names.add(match[1])
                    if line.startswith("constexpr"):  # further constants of the same declaration
                        names.update(re.findall(r", (k[A-Z]\w*) = ", line.split("//")[0]))
                    break
    return names


def clashes(files):
    """(folder, name) -> sources, where more than one; `files` is {path: text}."""
    seen = collections.defaultdict(list)
    for path, text in sorted(files.items()):
        if not APART.search(path):
            for name in names_of(text) - {"PrintTo"}:  # GoogleTest's: one overload a type
                seen[folder_of(path), name].append(path)
    return {key: paths for key, paths in seen.items() if len(paths) > 1}


def self_test():
    one = "namespace {\nconstexpr double kLeast = 1;\nvoid Add(int a,\n         int b) {\n}\n}  // namespace\n"
    assert set(clashes({"core/a.cc": one, "core/b.cc": one})) == {("core", "kLeast"), ("core", "Add")}
    assert not clashes({"core/a.cc": one, "rotor/b.cc": one})
    assert not clashes({"tests/core/a.cc": one, "tests/rotor/b.cc": one})
    assert clashes({"tests/core/math/a.cc": one, "tests/core/b.cc": one})
    assert not clashes({"actuators/a.cc": one, "actuators/b.cc": one})


def main():
    self_test()
    listed = subprocess.run(["git", "ls-files", "*.cc"], cwd=ROOT, check=True, capture_output=True, text=True)
    found = clashes({f: (ROOT / f).read_text() for f in listed.stdout.split() if (ROOT / f).is_file()})
    for (folder, name), paths in sorted(found.items()):
        print(f"{folder}: {name} stands in {', '.join(paths)}; allowed: one name once in the unnamed namespaces of a folder")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
