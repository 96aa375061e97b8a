#!/usr/bin/env python3
"""Runs every rotor that ROSS ships beside ambrig: saved by ROSS, converted by `ambrig rotor convert`, analysed by
`ambrig analyze`, and its modes, unbalance response and static deflection compared with ROSS's own.

    git clone --branch v2.3.0 https://github.com/petrobras/ross && pip install -r ross/requirements.txt
    python3 tools/compare_with_ross.py ross build/release/ambrig [--only NAME] [--keep DIR] [--markdown FILE]

Frequencies and damped poles: ROSS's matrices at each speed, eigenvalues by LAPACK and then iterated to the last digit;
largest relative difference of the lowest ten lateral poles. Unbalance: ROSS's run_unbalance_response at every node.
Static: ROSS's run_static, whose supports are rigid, against a copy of the file with rigid supports. ROSS smooths the
tables of its bearings (scipy's UnivariateSpline with its default s); it is run with s = 0, and the column `smoothing`
says what that changes in its own poles. Magnetic bearings are left out on both sides: ROSS takes them as springs."""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import scipy.linalg as la

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import ross_examples
from ross_poles import (MODES, RPM, is_bearing_with_table, lateral_dofs, matrices, oscillates,
                        pole_differences, poles, speeds_of, through_its_rows, without_magnets)

COLUMNS = ("mass", "frequency", "pole", "unbalance", "static", "moment", "smoothing")


class Program:
    def __init__(self, binary, folder):
        self.binary, self.folder = os.path.abspath(binary), pathlib.Path(folder)

    def run(self, *arguments):
        done = subprocess.run([self.binary, *map(str, arguments)], capture_output=True, text=True)
        return done.returncode, (done.stdout + done.stderr).strip()

    def convert(self, name, data):
        source, target, report = (self.folder / f"{name}{end}" for end in (".json", ".toml", ".convert.json"))
        source.write_text(json.dumps(data))
        code, text = self.run("rotor", "convert", source, target, "--json", report, "--force")
        if code:
            raise RuntimeError(text)
        magnets = any("g0" in v for v in data.values() if isinstance(v, dict))  # converted to a rig, analysed as a shaft
        return source if magnets else target, json.loads(report.read_text())["not_carried"]

    def analyse(self, shaft, *options):
        out = shaft.with_suffix(".analysis.json")
        code, text = self.run("analyze", shaft, "--json", out, "--force", "--modes", MODES, *options)
        if code not in (0, 1):
            raise RuntimeError(text)
        return json.loads(out.read_text())


def saved(rotor, folder):
    file = pathlib.Path(folder) / "ross.json"
    file.unlink(missing_ok=True)
    rotor.save(file)
    return json.loads(file.read_text())


def planes_of(rotor):
    """The nodes as ambrig names planes."""
    shafts = getattr(rotor, "shafts", None)
    if not shafts:
        last = max(e.n for e in rotor.shaft_elements if type(e).__name__ != "CouplingElement") + 1
        return [repr(float(z)) for z in rotor.nodes_pos[: last + 1]]
    return [f"shaft{k + 1}/{rotor.nodes_pos[n]!r}" for k, s in enumerate(shafts) for n in range(s[0].n, s[-1].n + 2)]


def compare_modes(rotor, analysis, speeds):
    f, c = 0.0, 0.0
    for row in analysis["campbell"]:
        if not any(abs(row["speed"] - s) < 1e-9 * max(1, s) for s in speeds):
            continue
        mine = [z for z in (complex(m["re"], m["im"]) for m in row["modes"]) if oscillates(z)]
        df, dc = pole_differences(mine, poles(rotor, row["speed"]))
        f, c = np.fmax(f, df), np.fmax(c, dc)
    return f, c


def compare_unbalance(rotor, analysis, node, end):
    """At five speeds of ambrig's grid within the tables of coefficients, beyond which ROSS extrapolates; all nodes of the
    shaft."""
    sweep = analysis["unbalance"][0]
    even = [k for k, w in enumerate(sweep["speed"]) if abs(w * 201 / end - round(w * 201 / end)) < 1e-6]  # not at a peak
    first = max([e.frequency[0] for e in rotor.bearing_elements if is_bearing_with_table(e)], default=0.0)
    even = [k for k in even if sweep["speed"][k] >= first]
    at = [min(even, key=lambda k: abs(sweep["speed"][k] - first - f * (end - first))) for f in (0.2, 0.35, 0.55, 0.75, 0.95)]
    speeds = np.array(sweep["speed"])[at]
    plane = sweep["planes"][0]
    theirs = rotor.run_unbalance_response(node, plane["magnitude"], plane["phase"], frequency=speeds).forced_resp
    worst = scale = 0.0
    for k, probe in enumerate(sweep["probes"]):
        for axis in ("x", "y"):
            mine = np.array(probe[axis])[at] * np.exp(1j * np.array(probe[axis + "_phase"])[at])
            dof = rotor.number_dof * k + (axis == "y")
            worst = np.maximum(worst, abs(mine - theirs[dof]))
            scale = np.maximum(scale, abs(theirs[dof]))
    return float(np.max(worst / scale))


def axial_force(rotor):
    """Of all elements alike; its moment N y about the undeformed axis is not in ROSS's figure."""
    forces = {float(getattr(e, "axial_force", 0) or 0) for e in rotor.shaft_elements}
    return forces.pop() if len(forces) == 1 else 0.0


def compare_static(rotor, data, program, name):
    rigid, named = {}, set()
    nodes = len(rotor.nodes)
    for key, value in data.items():
        if isinstance(value, dict) and "kxx" in value:
            if value["n"] >= nodes or key.startswith(("SealElement", "LabyrinthSeal", "HolePattern", "HybridSeal")):
                continue
            value = {"n": value["n"], "kxx": 1e20, "cxx": 0.0, "tag": value.get("tag")}
            key = f"BearingElement_b{value['n']}"
            if key in rigid:
                continue
        elif key.startswith("PointMass"):
            continue
        rigid[key] = value
    shaft, _ = program.convert(name + ".rigid", rigid)
    weight = program.analyse(shaft, "--speed", 1000)["weight"]
    static = rotor.run_static()
    scale = 9.80665 / 9.8065
    theirs = np.array(static.deformation if hasattr(static, "deformation") else static.displacement_y) * scale
    mine = np.array(weight["y"])
    y = np.max(abs(theirs - mine)) / np.max(abs(theirs))
    arm = axial_force(rotor) * np.interp(weight["at"], weight["z"], mine)
    moment = np.max(abs(np.array(static.Bm) * scale + np.array(weight["moment"]) - arm)) / np.max(abs(static.Bm)) / scale
    return y, moment


def compare_matrix_static(rotor, analysis, speed):
    """Of rotors whose run_static fails in ROSS itself (coaxial ones): its matrices under the weight, on their supports."""
    per, nodes = rotor.number_dof, len(analysis["weight"]["z"])
    lift = np.zeros(rotor.ndof)
    free = lateral_dofs(rotor)
    shaft_dofs = 4 * nodes
    lift[np.concatenate([free[1:shaft_dofs:4], free[shaft_dofs + 1 :: 2]])] = 1
    at = np.ix_(free, free)
    u = np.zeros(rotor.ndof)
    u[free] = la.solve(rotor.K(speed)[at], -9.80665 * (rotor.M(speed) @ lift)[free])
    theirs = u[1 : per * nodes : per]
    return np.max(abs(theirs - np.array(analysis["weight"]["y"]))) / np.max(abs(theirs))


def is_tapered(rotor):
    return any(e.idl != e.idr or e.odl != e.odr for e in rotor.shaft_elements)


def sizes(rotor):
    kinds = {}
    for e in rotor.elements:
        kinds[type(e).__name__] = kinds.get(type(e).__name__, 0) + 1
    return ", ".join(f"{n} {k.replace('Element', '')}" for k, n in kinds.items())


def compare(name, rotor, program):
    row = {"name": name, "elements": sizes(rotor), "notes": []}
    try:
        data = saved(rotor, program.folder)
    except Exception as e:
        raise RuntimeError(f"ROSS cannot save it ({e})")
    file = name.replace("#", "_").replace(" ", "_")
    shaft, row["not_carried"] = program.convert(file, data)
    if is_tapered(rotor):
        row["notes"].append("tapers: ROSS's element for them converges more slowly, below")
    if any(np.ravel(e.kxy)[0] * np.ravel(e.kyx)[0] == 0 != np.ravel(e.kxy)[0] + np.ravel(e.kyx)[0] for e in rotor.bearing_elements):
        row["notes"].append("a cross-coupling one way: at rest two poles are one, defective, known to the root of rounding")
    low, high, end = speeds_of(rotor)
    without_magnets(rotor)
    smooth = poles(rotor, high)
    through_its_rows(rotor)
    row["smoothing"] = pole_differences(smooth, poles(rotor, high))[1]
    node = rotor.disk_elements[0].n if rotor.disk_elements else len(rotor.nodes) // 2
    planes = planes_of(rotor)
    options = ["--speed", f"{low / RPM}:{high / RPM}", "--max-speed", end / RPM]
    options += ["--unbalance", f"{planes[node]}:100@30"]
    for plane in planes:
        options += ["--probe", plane]
    analysis = program.analyse(shaft, *options)
    row["mass"] = abs(analysis["mass"] / rotor.m - 1)
    row["frequency"], row["pole"] = compare_modes(rotor, analysis, (low, high))
    if analysis["unbalance"]:
        row["unbalance"] = compare_unbalance(rotor, analysis, node, end)
    if analysis["weight"]["held"]:
        if type(rotor).__name__ == "CoAxialRotor":
            row["static"] = compare_matrix_static(rotor, analysis, high)
        else:
            row["static"], row["moment"] = compare_static(rotor, data, program, file)
    return row


def number(x):
    return "" if x is None or not np.isfinite(x) else f"{x:.0e}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ross", help="checkout of petrobras/ross at v2.3.0")
    parser.add_argument("ambrig")
    parser.add_argument("--only", default="")
    parser.add_argument("--keep", help="folder for the files")
    parser.add_argument("--markdown")
    args = parser.parse_args()
    folder = args.keep or tempfile.mkdtemp()
    pathlib.Path(folder).mkdir(exist_ok=True, parents=True)
    program = Program(args.ambrig, folder)
    rotors, notebooks = ross_examples.collect(args.ross, lambda text: print("  " + text))
    rotors = [(name, rotor) for name, rotor in rotors if args.only in name]
    print(f"{'rotor':44} " + " ".join(f"{c[:8]:>8}" for c in COLUMNS))
    rows = []
    for name, rotor in rotors:
        try:
            row = compare(name, rotor, program)
        except Exception as e:
            row = {"name": name, "elements": sizes(rotor), "failed": f"{type(e).__name__}: {str(e)[:200]}"}
        rows.append(row)
        print(f"{name:44} " + (row.get("failed") or " ".join(f"{number(row.get(k)):>8}" for k in COLUMNS)), flush=True)
        for text in row.get("not_carried", []):
            print(f"    not carried: {text}")
    if args.markdown:
        pathlib.Path(args.markdown).write_text(markdown(rows) + "\n" + notebook_table(notebooks))


MERGED = 4  # more rotors of one notebook, such as a series of meshes, are one row of their largest differences


def merged(rows):
    places = {}
    for row in rows:
        places.setdefault(row["name"].split("#")[0], []).append(row)
    for place, group in places.items():
        if len(group) <= MERGED or any("failed" in row for row in group):
            yield from group
            continue
        elements = sorted((row["elements"] for row in group), key=lambda t: int(t.split()[0]))
        out = {"name": place, "elements": f"{len(group)} rotors, {elements[0]} to {elements[-1].split(',')[0]}"}
        for key in COLUMNS:
            out[key] = max((row[key] for row in group if row.get(key) is not None and np.isfinite(row[key])), default=None)
        for key in ("notes", "not_carried"):
            out[key] = list(dict.fromkeys(text for row in group for text in row[key]))
        yield out


def markdown(rows):
    text = "| rotor | elements | " + " | ".join(COLUMNS) + " | remarks |\n" + "|---" * (len(COLUMNS) + 3) + "|\n"
    for row in merged(rows):
        remarks = [row["failed"].split(": ", 1)[-1]] if "failed" in row else row["notes"] + ["not carried: " + n for n in shortened(row["not_carried"])]
        cells = [number(row.get(k)) for k in COLUMNS]
        text += f"| {row['name']} | {row['elements']} | " + " | ".join(cells) + f" | {'; '.join(remarks)} |\n"
    return text


def notebook_table(notebooks):
    """What became of every notebook."""
    text = "| notebook | rotors above | the same as | remarks |\n|---|---|---|---|\n"
    for name, remark, count, copies in notebooks:
        copies = [place for place in copies if place.split("#")[0] != name]
        copies = shortened(copies)
        none = "" if count or copies or "no version" in remark else "builds no rotor (bearings, seals, random rotors)"
        text += f"| {name} | {count or ''} | {', '.join(copies)} | {'; '.join(t for t in (remark, none) if t)} |\n"
    return text


def shortened(lines):
    return lines if len(lines) < 4 else lines[:2] + [f"{len(lines) - 2} more alike"]


if __name__ == "__main__":
    main()
