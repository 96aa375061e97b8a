#!/usr/bin/env python3
"""Fails when docs/third_party.md and what is really linked or bundled differ. Run by ctest.

    tools/check_third_party.py [BUILD_DIRECTORY]

Compared are the tables of the page with
  - the packages that CMake looks for (find_package, pkg_check_modules, find_library),
  - the Debian libraries that tools/setup.sh installs,
  - the dependencies in web/package-lock.json,
  - the licences in /usr/share/doc/PACKAGE/copyright, where the package is installed,
  - with a build directory: the libraries on the link line of `ambrig`, by the source package they come from.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys

PAGE = pathlib.Path("docs/third_party.md")
TOOLS = {"Git", "PkgConfig", "Python3"}  # found by CMake, linked to nothing


def tables():
    """Rows of every table of the page, as dictionaries by heading."""
    rows, heading = [], None
    for line in PAGE.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("|"):
            heading = None
        elif heading is None:
            heading = cells
        elif not set(line) <= set("|- "):
            rows.append(dict(zip(heading, cells)))
    return rows


def found_by_cmake():
    text = "\n".join(p.read_text() for p in [pathlib.Path("CMakeLists.txt"), *pathlib.Path("cmake").glob("*.cmake")])
    text = re.sub(r"#.*", "", text)
    names = set(re.findall(r"find_package\(\s*(\w+)", text)) - TOOLS
    names |= set(re.findall(r"find_library\(\s*\w+\s+(\w+)", text))
    for arguments in re.findall(r"pkg_check_modules\(\s*\w+([^)]*)\)", text):
        names |= {word for word in arguments.split() if not word.isupper() and word != "IMPORTED_TARGET"}
    return names


def installed_by_setup():
    script = pathlib.Path("tools/setup.sh").read_text()
    packages = re.search(r"^packages=\((.*?)^\)", script, re.S | re.M)[1]
    packages += "\n" + re.search(r"--python\) packages\+=\((.*?)\) ;;", script, re.S)[1]
    words = re.sub(r"#.*", "", packages).replace("python3-dev", "").split()  # the interpreter's own headers
    return {word for word in words if word.endswith("-dev")}


def bundled():
    lock = json.loads(pathlib.Path("web/package-lock.json").read_text())
    return {path.removeprefix("node_modules/"): entry.get("license", "")
            for path, entry in lock["packages"].items() if path and not entry.get("dev")}


def sources_of(packages):
    """The source package of every installed one, by its name; one call of dpkg-query for all."""
    done = subprocess.run(["dpkg-query", "-W", "-f=${Package} ${source:Package}\n", *sorted(packages)], capture_output=True, text=True)
    return dict(line.split() for line in done.stdout.splitlines() if len(line.split()) == 2)


def licences_of(package):
    """Licences that the package's copyright file names; None when the package is not installed."""
    file = pathlib.Path("/usr/share/doc") / package / "copyright"
    if not file.exists():
        return None
    text = file.read_text(errors="replace")
    lines = re.findall(r"^\s*License:\s*(.*)$", text, re.M)
    names = {word for line in lines for word in re.split(r"\s+(?:or|and|with)\s+|,\s*", line.strip())}
    # Older files have the text of the licence without a name.
    clauses = ("retain the above copyright", "Redistributions in binary form", "may not be used to endorse or promote")
    if re.search(r"^\s*License:\s*$", text, re.M) and all(clause in text for clause in clauses):
        names.add("BSD-3-clause")
    return names


def linked_libraries(build):
    """Libraries outside the build directory on the link line of ambrig, as ninja has it."""
    ninja = (build / "build.ninja").read_text()
    line = re.search(r"^build ambrig: .*?^  LINK_LIBRARIES = (.*?)$", ninja, re.S | re.M)
    if not line:
        sys.exit(f"{build}/build.ninja: no link line of ambrig")
    return sorted({word for word in line[1].split() if word.startswith("/")})


def owners_of(libraries):
    """The Debian package of every library, by the library's path; one call of dpkg for all."""
    paths = {library: {library, str(pathlib.Path(library).resolve())} for library in libraries}
    done = subprocess.run(["dpkg", "-S", *sorted(set().union(*paths.values()))], capture_output=True, text=True)
    owners = {}
    for line in done.stdout.splitlines():
        packages, _, path = line.rpartition(": ")
        owners[path] = packages.split(":")[0].split(",")[0]
    return {library: next((owners[p] for p in sorted(both) if p in owners), "") for library, both in paths.items()}


def compare(what, ours, theirs):
    return ([f"docs/third_party.md does not list {name} ({what})" for name in sorted(theirs - ours)] +
            [f"docs/third_party.md lists {name}, but it is not there ({what})" for name in sorted(ours - theirs)])


def check_link_line(build, listed):
    owners = owners_of(linked_libraries(build))
    sources = sources_of({*listed, *owners.values()} - {""})
    known = {sources[package] for package in listed if package in sources}
    bad = []
    for library, owner in owners.items():
        if not owner:
            bad.append(f"{library} is linked, but belongs to no Debian package")
        elif sources.get(owner) not in known:
            bad.append(f"docs/third_party.md does not list {owner}, which {library} belongs to")
    return bad


def main():
    rows = tables()
    debian = {row["Package"]: row["Licence"] for row in rows if "Package" in row}
    direct = {row["Package"] for row in rows if "Found by CMake as" in row}
    names = {row["Found by CMake as"] for row in rows if row.get("Found by CMake as", "-") != "-"}
    npm = {row["npm package"]: row["Licence"] for row in rows if "npm package" in row}
    bad = compare("CMakeLists.txt, cmake/", names, found_by_cmake())
    bad += compare("tools/setup.sh", direct, installed_by_setup())
    bad += compare("web/package-lock.json", set(npm), set(bundled()))
    for package, licence in debian.items():
        known = licences_of(package)
        if known is not None and licence not in known:
            bad.append(f"{package}: licence {licence}, its copyright file has: {', '.join(sorted(known))}")
    for package, licence in bundled().items():
        if npm.get(package, licence) != licence:
            bad.append(f"{package}: licence {npm[package]}, web/package-lock.json has {licence}")
    if len(sys.argv) > 1 and shutil.which("dpkg"):
        bad += check_link_line(pathlib.Path(sys.argv[1]), debian)
    print("\n".join(bad))
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
