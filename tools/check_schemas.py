#!/usr/bin/env python3
"""Validates what the commands write as JSON against schemas/. Run by ctest (json_schemas).

    tools/check_schemas.py PROGRAM [--slow]

Every schema must be one (JSON Schema, draft 2020-12) and be used here; every command that takes --json must have a schema. A schema
allows no key that it does not name, so a new key of a document needs a line in its schema (and a new version of it, NAME-2.json, when an
old reader would misread the document). --slow: also what takes minutes (explain, practice, detectors, ...)."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
RIG = "examples/reference/rig.toml"
CAMPAIGN = f"""name = "small"
rig = "{RIG}"
duration = 0.01
[faults]
bearings = ["A"]
sets = "single"
time = 0.002
[[faults.kind]]
kind = "open"
[operation]
speeds = [0.0]
[spread]
draws = 1
"""
LATER = f"""name = "later"
rig = "{RIG}"
duration = 0.05
[[fault]]
time = 0.03
target = "A.coil3"
kind = "open"
"""
# (schema, arguments, exit codes that are no error), in this order: some need files of those before.
CHEAP = [
    ("run", "run examples/reference/coil_opens.toml --out a", {0}),
    ("run", "run examples/reference/coil_opens.toml scenarios/library/lift_off.toml --out b --no-report", {0}),
    ("run", "run scenarios/library/lift_off.toml nothing.toml --out c --no-report --keep-going", {2}),
    ("run", "run later.toml --out d --no-report", {0}),
    ("run", "run examples/tum_mbtr/drop.toml --out e --no-report", {0}),
    ("run", "check scenarios/library/lift_off.toml", {0}),
    ("diff", "diff a/coil_opens.h5 b/coil_opens.h5", {0}),
    ("diff", "diff a/coil_opens.h5 d/later.h5", {1}),
    ("diff_rigs", f"diff {RIG} examples/small_spindle/rig.toml", {1}),
    ("rig", f"rig {RIG}", {0}),
    ("rig", "rig examples/design/pid.toml", {0}),
    ("rig", "rig examples/tum_mbtr/rig.toml", {0}),
    ("rotor", "rotor convert examples/tum_mbtr/rig.toml rotor.json", {0}),
    ("redistribute", f"redistribute {RIG} --bearing A --failed 1,2", {0}),
    ("redistribute", "redistribute examples/stators/six_poles.toml --failed 1", {0}),
    ("export", f"export {RIG} --controller-c c.c", {0}),
    ("export", f"export {RIG} --fmu rig.fmu", {0}),
    ("analyze", f"analyze {RIG} --measure 2 --response A.x.load:A.x", {0}),
    ("analyze_shaft", "analyze examples/shaft/shaft.toml --speed 4000 --unbalance disk2:50@90", {0}),
    ("analyze_shaft", "analyze examples/shaft/shaft.toml --speed 4000 --campbell", {0}),
    ("analyze_shaft", "analyze examples/shaft/shaft.toml --speed 4000 --cross-coupling 0.6:2e6 --shake disk2:10:0 --scatter 5", {0}),
    ("validate", "validate examples/validation/mbc500.validation.toml", {0}),
    ("effects", "effects", {0}),
    ("effects", "effects eddy-currents", {0}),
    ("parameters", "parameters", {0}),
    ("channels", "channels examples/mls2em/data/force_05.csv a/coil_opens.h5", {0}),
    ("compare", "compare examples/rub/case.toml", {0}),
    ("new", "new --list", {0}),
    ("new", "new --answers examples/new/spindle.toml --only-files -o spindle", {0}),
    ("watch", "watch examples/rub/case.toml examples/rub --no-explain --settle 0", {0, 1}),
    ("campaign", "campaign small.toml -o campaign", {0}),
    ("campaign", "merge campaign -o merged", {0}),
]
SLOW = [
    ("crosscheck", "crosscheck scenarios/library/drop_at_0rpm.toml", {0, 1}),
    ("commission", f"commission {RIG} -o learnt.toml", {0}),
    ("paper", "paper examples/paper", {0}),
    ("design", "design examples/design/small.toml -o study", {0}),
    ("design_point", "design examples/design/small.toml -o study --point 1", {0}),
    ("detectors", "detectors scenarios/studies/detectors_small.toml -o detectors", {0}),
    ("explain", "explain practice/case.toml", {0, 1}),
    ("adopt", "adopt practice/case.toml sensor-gain -o with_gain.toml", {0}),
    ("refine", "refine practice/case.toml saturation -o refined.toml", {0}),
    ("plan", f"plan {RIG} --learn side-pull@A cross-coupling@A", {0, 1}),
    ("practice", f"practice {RIG} --cases 1 -o practised", {0, 1}),
    ("practice_plans", f"practice {RIG} --plans --cases 1 -o planned", {0, 1}),
    ("score", "score practice -o scored", {0, 1}),
]
# Commands whose document has a schema of another name; none: they write no JSON although they take the option.
OTHER_NAME = {"check": "run", "merge": "campaign"}


def commands_with_json(program):
    """The commands that take --json, by their helps."""
    text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    part = re.split(r"^[Ss]ubcommands:\n", text, flags=re.M)[1].split("\n\n")[0]
    names = re.findall(r"^  ([a-z]+)(?:, [a-z]+)* ", part, re.M)
    return [name for name in names
            if "--json" in subprocess.run([program, name, "--help"], capture_output=True, text=True, check=True).stdout]


def schemas(jsonschema):
    """Name -> validator of the newest version."""
    found = {}
    for file in sorted((ROOT / "schemas").glob("*.json"), key=lambda f: int(f.stem.rpartition("-")[2])):
        name, _, version = file.stem.rpartition("-")
        schema = json.loads(file.read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        if schema["$id"] != f"urn:ambrig:schema:{name}:{version}":
            sys.exit(f"{file}: $id {schema['$id']}")
        found[name] = jsonschema.Draft202012Validator(schema)
    return found


def place(error):
    return "/".join(map(str, error.absolute_path)) or "the document"


def deepest(error):
    """Of "fits none of these" the reason of what came furthest."""
    while error.context:
        error = max(error.context, key=lambda e: len(e.absolute_path))
    return error


def main():
    try:
        import jsonschema
    except ImportError:
        print("python3-jsonschema is not installed (tools/setup.sh --tests)")
        return 77
    program = str(pathlib.Path(sys.argv[1]).resolve())
    known, bad = schemas(jsonschema), []
    slow = "--slow" in sys.argv
    rows = CHEAP + (SLOW if slow else [])
    if not (pathlib.Path(program).parent / "ambrig_fmu.so").exists():  # not built with sanitizers (cmake/fmu.cmake)
        rows = [row for row in rows if "--fmu" not in row[1]]
    used = {schema for schema, _, _ in CHEAP + SLOW}
    bad += [f"schemas/{name}: no command here writes it" for name in sorted(set(known) - used)]
    bad += [f"ambrig {name}: no schema of its JSON" for name in commands_with_json(program)
            if OTHER_NAME.get(name, name) not in known]
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        for name in ("examples", "scenarios"):
            shutil.copytree(ROOT / name, folder / name)
        (folder / "small.toml").write_text(CAMPAIGN)
        (folder / "later.toml").write_text(LATER)
        environment = dict(os.environ, AMBRIG_CACHE=str(folder / "cache"))
        if slow:
            subprocess.run([program, "hide", "sensor-gain", "--rig", RIG, "-o", "practice"], cwd=folder, check=True, capture_output=True)
        for number, (name, arguments, codes) in enumerate(rows):
            out = folder / f"out_{number}.json"
            done = subprocess.run([program, *arguments.split(), "--json", str(out)], cwd=folder, env=environment, capture_output=True,
                                  text=True)
            if done.returncode not in codes or not out.exists():
                bad.append(f"ambrig {arguments}: exit {done.returncode} {done.stderr.strip()[:300]}")
                continue
            errors = [deepest(e) for e in known[name].iter_errors(json.loads(out.read_text()))] if name in known else []
            bad += [f"ambrig {arguments}: {place(e)}: {e.message[:200]} (schemas/{name})" for e in errors[:3]]
    print("\n".join(bad) if bad else f"{len(rows)} documents fit {len({r[0] for r in rows})} of {len(known)} schemas")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
