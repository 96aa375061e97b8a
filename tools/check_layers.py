#!/usr/bin/env python3
"""Checks who includes whom (docs/architecture.md). Run by ctest, with --self-test too.

Four rules over every #include of the sources, and one over their text:
  layers   a room includes from itself and from the rooms that MAY_INCLUDE names;
  rooms    the folders inside a folder of ROOMED (and its own files, as one more) depend on each other one way
           only: no room is reached again from what it includes;
  bans     what runs in the controller never includes a header of the plant (BANNED), not even
           through another header, where it would be in sight all the same;
  doors    a library is included by the files that DOORS names and by no other;
  kinds    nobody but rig/bearing_kinds and the reader of rig files asks which kind a bearing is: what it
           can do stands in the kind's own file (rig/parameters/bearing_kind.h).
Every file and folder named here must exist, so that no rule outlives what it is about.
"""
import pathlib
import re
import sys

# A room may include from itself and from what stands beside it here; a room with a layer of its own
# (analysis/linear) is named with its folder.
MAY_INCLUDE = {
    "core": "",
    "actuators": "core",
    "rotor": "core",
    "control": "core actuators",
    "effects": "core actuators rotor control",
    "rig": "core actuators rotor control effects",
    "fdd": "core actuators control rig",
    "faulttolerance": "core actuators control rig fdd",
    "scenarios": "core rotor effects rig faulttolerance",
    "analysis/linear": "core actuators rotor control effects rig",
    "simulation": "core actuators rotor control effects rig fdd faulttolerance scenarios analysis/linear",
    "analysis": "core actuators rotor control effects rig faulttolerance simulation scenarios analysis/linear",
    "discovery": "core actuators control rotor effects rig scenarios simulation analysis analysis/linear",
    "campaign": "core effects fdd faulttolerance rig scenarios simulation",
    "design": "core control rig scenarios simulation analysis/linear campaign",
    "fmu": "core rig scenarios simulation",
    "fmu/library": "core rotor control effects fmu",
    "workbench": "core",
    "app": "core fmu control effects rig scenarios simulation discovery campaign analysis design faulttolerance rotor fdd workbench",
    "bench": "core actuators rotor control fdd faulttolerance effects rig scenarios simulation discovery campaign",
}

# Folders whose rooms may not depend in circles.
ROOMED = """core actuators rotor control effects rig fdd faulttolerance scenarios simulation analysis campaign design fmu discovery
workbench app""".split()

# Headers of the plant: the bridge, the magnetics that are simulated, the moving rotor and its contacts,
# the speed sensor, the true rig, what puts faults in.
PLANT_HEADERS = """
actuators/electronics/current_measurement.h
actuators/electronics/power_bridge.h
actuators/magnetics/coil_network.h
actuators/magnetics/flux_law.h
actuators/magnetics/running_stator.h
actuators/magnetics/stator_lanes.h
actuators/magnetics/stator_loop.h
effects/plant.h
rig/rig_assembly.h
rig/rig_file.h
rig/true_rig.h
rotor/crosscheck/ode_rotor.h
rotor/crosscheck/ode_world.h
rotor/motion/position_sensor.h
rotor/motion/rotor_model.h
rotor/motion/rotor_stepper.h
rotor/motion/speed_sensor.h
scenarios/faults/fault.h
scenarios/faults/fault_spec.h
scenarios/faults/faulted_plant.h
simulation/sampled/sampled_data_loop.h
""".split()
# What runs in the controller sees what it measures and the nominal rig only.
BANNED = {room: PLANT_HEADERS for room in ("control", "fdd", "faulttolerance")}

# One door per library: the only files that may include it.
DOORS = {
    "toml++/": ["core/base/toml_node.h", "fmu/library/statically_linked.cc"],
    "core/base/toml_node.h": ["core/base/toml.cc", "core/base/toml_lists.cc", "core/base/toml_nesting.cc", "core/base/toml_edit.cc",
                              "core/base/toml_place.h"],
    "core/base/toml_place.h": ["core/base/toml_edit.cc", "core/base/toml_place.cc"],
    "hdf5.h": ["core/record/hdf5_library.h"],
    "core/record/hdf5_library.h": ["core/record/hdf5_reader.cc", "core/record/hdf5_writer.cc"],
    "core/math/sundials.h": ["core/math/cvode.cc", "core/math/kinsol.cc"],
    "sundials/": ["core/math/sundials.h"],
    "nvector/": ["core/math/sundials.h"],
    "sunlinsol/": ["core/math/sundials.h"],
    "sunmatrix/": ["core/math/sundials.h"],
    "cvode/": ["core/math/cvode.cc"],
    "arkode/": ["core/math/cvode.cc"],
    "kinsol/": ["core/math/kinsol.cc"],
    "matio.h": ["core/record/mat_library.h"],
    "core/record/mat_library.h": ["core/record/mat.cc", "core/record/mat_library.cc", "core/record/mat_writer.cc",
                                  "core/record/mat_structs.h", "core/record/mat_structs.cc"],
    "core/record/mat_structs.h": ["core/record/mat.cc", "core/record/mat_structs.cc"],
    "microhttpd.h": ["workbench/http_server.cc"],
    "ode/": ["rotor/crosscheck/ode_world.cc"],
    "oneapi/tbb": ["analysis/shaft/shaft_scatter.cc", "campaign/run_rows.cc", "app/commands/check.cc", "discovery/model/in_parallel.cc"],
    "ceres/": ["discovery/search/fit.cc"],
    "muParser": ["effects/formula_parser.cc"],
    "nlopt": ["design/nlopt_search.cc", "faulttolerance/redistribution/program_search.cc"],
    "pugixml": ["app/commands/check.cc", "fmu/description.cc", "control/external/fmu_description.cc"],
    "zip.h": ["core/base/zip_file.cc"],
    "CLI/": ["app/commands/commands.h", "app/commands/outputs.h"],
}

# A bearing's kind told by its name or by its row of the catalogue, instead of by what it can do.
WHICH_KIND = re.compile(r"kind->name *[!=]=|[!=]= *&?(?:Radial|Thrust|Opposed)Bearing\(\)|FindBearingKind\(")
MAY_ASK_WHICH = ("rig/bearing_kinds/", "rig/parameters/bearing_kind.", "rig/rig_file.cc")

INCLUDE = re.compile(r'\s*#include (["<])([^">]+)[">]')


def room_of(path):
    """The longest known room that a path lies in: analysis/linear before analysis."""
    parts = path.split("/")
    two = "/".join(parts[:2])
    return two if two in MAY_INCLUDE else parts[0]


def includes_of(root):
    """Path -> [(line, own header?, included path)] of every source in the rooms below `root`."""
    found = {}
    for top in sorted({room.split("/")[0] for room in MAY_INCLUDE}):
        for file in sorted((root / top).rglob("*.[hc]*")):
            if file.suffix == ".c":  # a program of its own: control/external/host
                continue
            matches = ((n, INCLUDE.match(line)) for n, line in enumerate(file.read_text().splitlines(), 1))
            found[file.relative_to(root).as_posix()] = [(n, m[1] == '"', m[2]) for n, m in matches if m]
    return found


def way_to(banned, path, includes, seen):
    """The chain of own headers from `path` to a banned one, [] when there is none."""
    if path in banned:
        return [path]
    if path in seen:
        return []
    seen.add(path)
    for _, own, target in includes.get(path, []):
        chain = way_to(banned, target, includes, seen) if own else []
        if chain:
            return [path, *chain]
    return []


def asks_which_kind(file, text):
    """A line for every comparison of a bearing's kind in a file that may make none."""
    if file.startswith(MAY_ASK_WHICH):
        return []
    return [f"{file}:{n}: asks which kind a bearing is; allowed: what it can do (rig/parameters/bearing_kind.h)"
            for n, line in enumerate(text.splitlines(), 1) if WHICH_KIND.search(line)]


def inner_room(path):
    """core/math of core/math/fft.h; the folder itself of a file that lies in no room."""
    return "/".join(path.split("/")[:2]) if path.count("/") > 1 else path.split("/")[0]


def room_edges(folder, includes):
    """Room -> {room that it includes from: (file, line, included path)}, of the rooms of one folder."""
    edges = {}
    for file, lines in includes.items():
        for number, own, path in lines if file.startswith(folder + "/") else []:
            ends = inner_room(file), inner_room(path)
            if own and path.startswith(folder + "/") and ends[0] != ends[1]:
                edges.setdefault(ends[0], {}).setdefault(ends[1], (file, number, path))
    return edges


def circle_from(start, edges):
    """Rooms of the shortest way from a room back to it, [] when there is none."""
    ways, seen = [[start]], {start}
    for way in ways:
        for room in edges.get(way[-1], {}):
            if room == start:
                return [*way, start]
            if room not in seen:
                seen.add(room)
                ways.append([*way, room])
    return []


def circles(folder, includes):
    """A line for every include on a circle of rooms; each circle is told once."""
    bad, told = [], set()
    edges = room_edges(folder, includes)
    for start in sorted(edges):
        circle = circle_from(start, edges)
        if not circle or told & set(circle):
            continue
        told |= set(circle)
        for a, b in zip(circle, circle[1:]):
            file, number, path = edges[a][b]
            bad.append(f"{file}:{number}: includes {path}, and rooms depend in a circle: {' -> '.join(circle)}")
    return bad


def dead_names(exists):
    """Rooms, banned headers and doors that this file names and that do not exist."""
    named = {*MAY_INCLUDE, *ROOMED, *PLANT_HEADERS, *(door for doors in DOORS.values() for door in doors)}
    return [f"tools/check_layers.py names {name}, which does not exist" for name in sorted(named) if not exists(name)]


def complaints(file, includes):
    """What is wrong with the includes of one file, a line each."""
    bad, room = [], room_of(file)
    known, banned = {room, *MAY_INCLUDE[room].split()}, BANNED.get(room, [])
    for number, own, path in includes[file]:
        if own and room_of(path) not in known:
            bad.append(f"{file}:{number}: {room} may not include from {room_of(path)}")
        chain = way_to(banned, path, includes, set()) if own and banned else []
        if chain:
            bad.append(f"{file}:{number}: {room} may not see {' <- '.join(reversed(chain))}")
        for library, doors in DOORS.items():
            if path.startswith(library) and file not in doors:
                bad.append(f"{file}:{number}: only {', '.join(doors)} may include {path}")
    return bad


def check(root):
    includes = includes_of(root)
    named = dead_names(lambda name: (root / name).exists())
    kinds = [b for f in includes for b in asks_which_kind(f, (root / f).read_text())]
    rooms = [b for folder in ROOMED for b in circles(folder, includes)]
    return named + [b for f in includes for b in complaints(f, includes)] + rooms + kinds


def self_test(root):
    """Plants one violation of every rule beside the sources and sees each of them caught."""
    plants = [("core/planted.h", '#include "app/json/run_json.h"', "core may not include from app"),
              ("rig/planted.cc", '#include "simulation/simulate.h"', "rig may not include from simulation")]
    for room in BANNED:
        plants += [(f"{room}/planted.cc", f'#include "{header}"', f"{room} may not see {header}")
                   for header in PLANT_HEADERS]
    for library in DOORS:
        quoted = f'"{library}"' if library.endswith(".h") and "/" in library else f"<{library}>"
        plants.append(("analysis/planted.cc", f"#include {quoted}", f"may include {library}"))
    # through a header of the room's own, which the chain names
    plants.append(("fdd/planted.cc", '#include "fdd/planted.h"', "fdd may not see effects/plant.h <- fdd/planted.h"))
    sources = includes_of(root)
    sources["fdd/planted.h"] = [(1, True, "effects/plant.h")]
    missed = []
    for path, line, complaint in plants:
        match = INCLUDE.match(line)
        planted = {**sources, path: [(1, match[1] == '"', match[2])]}
        if not any(b.startswith(path + ":1:") and complaint in b for b in complaints(path, planted)):
            missed.append(f"not caught: {line} in {path}")
    for folder, file, header in (("core", "core/base/planted.cc", "core/record/record.h"),
                                 ("simulation", "simulation/record/planted.h", "simulation/simulate.h"),
                                 ("rig", "rig/parameters/planted.h", "rig/rig_file.h"),
                                 ("discovery", "discovery/case/planted.cc", "discovery/model/case_model.h")):
        planted = {**includes_of(root), file: [(1, True, header)]}
        if not any(b.startswith(file + ":1:") for b in circles(folder, planted)):
            missed.append(f"not caught: a circle of rooms by {header} in {file}")
    for line in ('if (b.kind->name == "radial") return;', "return bearing.kind != &ThrustBearing();",
                 'const bool z = b.kind == FindBearingKind("thrust");'):
        if not asks_which_kind("fdd/planted.cc", line) or asks_which_kind("rig/bearing_kinds/planted.cc", line):
            missed.append(f"not caught: {line}")
    if len(dead_names(lambda name: (root / name).exists() and name != "effects/plant.h")) != 1:
        missed.append("not caught: a ban of a file that does not exist")
    return missed


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    bad = self_test(root) if sys.argv[1:] == ["--self-test"] else check(root)
    print("\n".join(bad))
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
