#!/usr/bin/env python3
"""Fails when a folder includes from a folder it may not know (docs/architecture.md). Run by ctest."""
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
    "scenarios": "core effects rig faulttolerance",
    "analysis/linear": "core actuators rotor control rig",
    "simulation": "core actuators rotor control effects rig fdd faulttolerance scenarios analysis/linear",
    "analysis": "core actuators rotor control effects rig faulttolerance simulation scenarios analysis/linear",
    "discovery": "core actuators control rotor effects rig scenarios simulation",
    "campaign": "core fdd faulttolerance rig scenarios simulation",
    "design": "core control rig scenarios simulation analysis/linear campaign",
    "app": "core effects rig scenarios simulation discovery campaign analysis design faulttolerance rotor fdd",
    "bench": "core actuators rotor control fdd faulttolerance effects rig scenarios simulation discovery",
}
# What runs in the controller may not look at the true fault, only at what it measures.
BANNED = {"fdd": ["actuators/coil_fault.h"], "faulttolerance": ["actuators/coil_fault.h"]}
# One door per library: the only files that may include it.
DOORS = {
    "toml++/": ["core/base/toml_node.h"],
    "core/base/toml_node.h": ["core/base/toml.cc", "core/base/toml_lists.cc", "core/base/toml_nesting.cc", "core/base/toml_edit.cc",
                              "core/base/toml_place.h"],
    "core/base/toml_place.h": ["core/base/toml_edit.cc", "core/base/toml_place.cc"],
    "hdf5.h": ["core/record/hdf5.cc"],
    "matio.h": ["core/record/mat.cc"],
    "ode/": ["rotor/contact/ode_world.cc"],
    "oneapi/tbb": ["campaign/run_rows.cc", "app/commands/check.cc", "discovery/model/model.cc", "discovery/search/screen.cc"],
    "ceres/": ["discovery/search/fit.cc"],
    "muParser": ["effects/formula_parser.cc"],
    "nlopt": ["design/nlopt_search.cc"],
}


def room_of(path):
    """The longest known room that a path lies in: analysis/linear before analysis."""
    parts = path.split("/")
    two = "/".join(parts[:2])
    return two if two in MAY_INCLUDE else parts[0]


def main():
    bad = []
    for file in sorted(path for top in {room.split("/")[0] for room in MAY_INCLUDE}
                       for path in pathlib.Path(top).rglob("*.[hc]*")):
        room = room_of(str(file))
        known = {room, *MAY_INCLUDE[room].split()}
        for number, line in enumerate(file.read_text().splitlines(), 1):
            match = re.match(r'\s*#include ["<]([^">]+)[">]', line)
            if not match:
                continue
            path = match[1]
            if '"' in line and room_of(path) not in known:
                bad.append(f"{file}:{number}: {room} may not include from {room_of(path)}")
            if path in BANNED.get(room, []):
                bad.append(f"{file}:{number}: {room} may not see {path}")
            for library, doors in DOORS.items():
                if path.startswith(library) and str(file) not in doors:
                    bad.append(f"{file}:{number}: only {', '.join(doors)} may include {path}")
    print("\n".join(bad))
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
