#!/usr/bin/env python3
"""Whether CONTRIBUTING.md's table "Where a change goes" tells the truth. Run by ctest.

    tools/planted_change.py BUILD_FOLDER

In a scratch copy of the sources one effect, detector, fault, controller, kind of bearing and command are added from the
templates of tests/planted/: a new file where the table says, and one line where the table says. Then
  - nothing else may differ from the original: one new file a kind, one more line in each catalogue;
  - new files and catalogues are compiled with the build's own options and linked with the libraries of the build folder;
  - the program that results lists, documents and runs all six together (tests/planted/scenario.toml).
"""
import difflib
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parent.parent
NAME = "planted_change"
KINDS = ["effect", "detector", "fault", "controller", "bearing", "command"]


def fail(text):
    print(f"planted_change: {text}")
    sys.exit(1)


def table_rows():
    """kind -> (pattern of the new file, file that gets one line), from CONTRIBUTING.md."""
    rows = {}
    for line in (ROOT / "CONTRIBUTING.md").read_text().splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("| ") or len(cells) != 3:
            continue
        kind = cells[0].split()[0]
        new, one_line = re.findall(r"`([^`]*NAME[^`]*)`", cells[1]), re.findall(r"`([^`]+)`", cells[2])
        if kind in KINDS:
            if len(new) != 1 or len(one_line) != 1:
                fail(f"CONTRIBUTING.md, row {kind}: allowed: one new file and one line, not {new} and {one_line}")
            rows[kind] = (new[0], one_line[0])
    for kind in KINDS:
        if kind not in rows:
            fail(f"CONTRIBUTING.md has no row for a new {kind}")
    return rows


def copy_sources(scratch):
    files = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                           capture_output=True, text=True).stdout.split("\n")
    for name in files:
        if pathlib.Path(name).suffix not in (".cc", ".h") or not (ROOT / name).is_file():
            continue
        target = scratch / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, target)


def plant(scratch, kind, new, catalogue):
    """The template at its place, its name first in the catalogue's list."""
    template = (ROOT / "tests/planted" / f"{kind}.cc").read_text()
    first, text = template.split("\n", 1)
    entry = re.fullmatch(r"// catalogue: (\w+)", first)
    if not entry:
        fail(f"tests/planted/{kind}.cc: the first line is not \"// catalogue: NAME\"")
    target = scratch / new
    if target.exists():
        fail(f"{new} exists already")
    target.write_text(text)
    lines = (scratch / catalogue).read_text().split("\n")
    heads = [k for k, line in enumerate(lines) if re.match(r"#define AMBRIG_\w+\((\w+)\)\s*\\$", line)]
    if len(heads) != 1:
        fail(f"{catalogue}: {len(heads)} lists, allowed: one")
    macro = re.search(r"\((\w+)\)", lines[heads[0]])[1]
    lines.insert(heads[0] + 1, f"  {macro}({entry[1]}) \\")
    (scratch / catalogue).write_text("\n".join(lines))


def changed_files(scratch):
    """(new files, {changed file: added lines}); anything removed is a failure."""
    new, changed = set(), {}
    for file in sorted(path for path in scratch.rglob("*") if path.is_file()):
        name = str(file.relative_to(scratch))
        if not (ROOT / name).exists():
            new.add(name)
        elif file.read_bytes() != (ROOT / name).read_bytes():
            old, now = (ROOT / name).read_text().splitlines(), file.read_text().splitlines()
            diff = [line for line in difflib.unified_diff(old, now, n=0, lineterm="")
                    if line[0] in "+-" and line[:3] not in ("+++", "---")]
            if any(line[0] == "-" for line in diff):
                fail(f"{name}: lines were taken away")
            changed[name] = len(diff)
    return new, changed


def compile_command(build, like, source, output, scratch):
    """The command of compile_commands.json for `like`, turned to `source` of the scratch copy, without precompiled headers."""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        if entry["file"] != str(ROOT / like):
            continue
        words = shlex.split(entry["command"])
        out, skip = [], False
        for k, word in enumerate(words):
            if skip:
                skip = False
            elif word in ("-o", "-c", "-MF", "-MT") or (word == "-include" and "cmake_pch" in words[k + 1]):
                skip = True
            elif word == f"-I{ROOT}":
                out.append(f"-I{scratch}")
            elif word not in ("-MD", "-Winvalid-pch"):
                out.append(word)
        return out + ["-O0", "-c", str(source), "-o", str(output)], entry["directory"]
    return fail(f"{like} is not in {build}/compile_commands.json")


def run(command, cwd):
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True)
    if done.returncode != 0:
        fail(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def build_program(build, scratch, rows):
    jobs, objects = [], []
    for kind, (pattern, catalogue) in rows.items():
        for source in (pattern.replace("NAME", NAME), catalogue):
            output = scratch / (kind + "_" + pathlib.Path(source).stem + ".o")
            objects.append(str(output))
            jobs.append(compile_command(build, catalogue, scratch / source, output, scratch))
    with ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda job: run(*job), jobs))
    program = scratch / "ambrig"
    link = run(["ninja", "-C", str(build), "-t", "commands", "ambrig"], ROOT).strip().split("\n")[-1]
    words = shlex.split(link)
    words = words[words.index("&&") + 1:] if words[:2] == [":", "&&"] else words
    words = words[:words.index("&&")] if "&&" in words else words
    at = words.index("-o")
    words[at + 1] = str(program)
    first_archive = next(k for k, word in enumerate(words) if word.endswith(".a"))
    run(words[:first_archive] + objects + words[first_archive:], build)
    return program


def check_program(program, scratch):
    run([program, "planted", "--json", scratch / "planted.json"], scratch)
    effects = json.loads((scratch / "planted.json").read_text())["effects"]
    listed = json.loads(run_json(program, scratch, "effects"))
    if len(listed) != effects:
        fail(f"ambrig planted counts {effects} effects, ambrig effects {len(listed)}")
    page = run([program, "parameters", "--markdown"], scratch)
    for text in ('[[fault]] kind = "planted-sensor"', '[controller] kind = "planted"', "stiffness", '[bearings.Z] kind = "planted-axial"'):
        if text not in page:
            fail(f"ambrig parameters does not tell of {text}")
    rig = (ROOT / "examples/reference/rig.toml").read_text()
    rig, found = re.subn(r'kind = "pid"\n', 'kind = "planted"\nstiffness = 4.0e5\ndamping = 900.0\n', rig)
    rig, axial = re.subn(r'kind = "thrust"\n', 'kind = "planted-axial"\n', rig)
    if axial != 1:
        fail("examples/reference/rig.toml: no thrust bearing to replace")
    head, tail = rig.split("[controller]\n", 1)
    body, rest = tail.split("\n[", 1)
    body = "\n".join(line for line in body.split("\n") if not re.match(r"(kp|kd|ki|derivative_time_constant) =", line))
    if found != 1:
        fail("examples/reference/rig.toml: no [controller] kind to replace")
    rest, detectors = re.subn(r"detection\]\n", 'detection]\nkind = "planted"\n', rest)
    if detectors != 1:
        fail("examples/reference/rig.toml: no [detection] to give a kind")
    (scratch / "rig.toml").write_text(head + "[controller]\n" + body + "\n[" + rest
                                      + (ROOT / "tests/planted/rig_additions.toml").read_text())
    shutil.copy(ROOT / "tests/planted/scenario.toml", scratch / "scenario.toml")
    print(run([program, "check", scratch / "scenario.toml"], scratch).strip())


def run_json(program, scratch, command):
    run([program, command, "--json", scratch / f"{command}.json"], scratch)
    return (scratch / f"{command}.json").read_text()


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    rows = table_rows()
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        copy_sources(scratch)
        for kind, (pattern, catalogue) in rows.items():
            plant(scratch, kind, pattern.replace("NAME", NAME), catalogue)
        new, changed = changed_files(scratch)
        wanted_new = {pattern.replace("NAME", NAME) for pattern, _ in rows.values()}
        wanted_changed = {catalogue: 1 for _, catalogue in rows.values()}
        if new != wanted_new or changed != wanted_changed:
            fail(f"new: {sorted(new)}, changed: {changed}; allowed: {sorted(wanted_new)}, {wanted_changed}")
        check_program(build_program(build, scratch, rows), scratch)
    print(f"{len(rows)} kinds of change: one new file and one line each")


if __name__ == "__main__":
    main()
