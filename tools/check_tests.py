#!/usr/bin/env python3
"""Fails where a test does not lie where what it tests lies. Run by ctest.

tests/ mirrors the folders of FOLDERS: a test that is named after a source lies in that source's room, no test lies beside the
rooms of a folder whose sources all lie in rooms, and no room of tests is without sources."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = """core actuators rotor control effects rig fdd faulttolerance scenarios simulation analysis campaign design fmu
workbench app""".split()


def sources_of(folder):
    """Name -> rooms of the sources of that name, and every room."""
    names, rooms = {}, set()
    for file in sorted((ROOT / folder).rglob("*.[hc]*")):
        room = file.parent.relative_to(ROOT).as_posix()
        rooms.add(room)
        names.setdefault(file.stem, set()).add(room)
    return names, rooms


def main():
    bad = []
    for folder in FOLDERS:
        names, rooms = sources_of(folder)
        flat = any(f.suffix == ".cc" and f.name != "main.cc" for f in (ROOT / folder).iterdir())
        for test in sorted((ROOT / "tests" / folder).rglob("*_test.cc")):
            file = test.relative_to(ROOT).as_posix()
            room = test.parent.relative_to(ROOT / "tests").as_posix()
            wanted = names.get(test.name[:-len("_test.cc")], set())
            if wanted and room not in wanted:
                bad.append(f"{file}: allowed: tests/{' or tests/'.join(sorted(wanted))}, where its source lies")
            elif room not in rooms:
                bad.append(f"{file}: {room} has no sources")
            elif room == folder and not flat:
                bad.append(f"{file}: allowed: a room, as the sources of {folder} all lie in rooms")
    print("\n".join(bad))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
