#!/usr/bin/env python3
"""Fails when a folder includes from a folder it may not know (docs/architecture.md). Run by ctest."""
import pathlib
import re
import sys

MAY_INCLUDE = {
    "core": "",
    "actuators": "core",
    "rotor": "core",
    "control": "core actuators",
    "fdd": "core actuators",
    "faulttolerance": "core actuators control fdd",
    "effects": "core actuators rotor control",
    "scenarios": "core actuators rotor control fdd faulttolerance effects",
    "discovery": "core effects scenarios",
    "campaign": "core faulttolerance scenarios",
    "analysis": "core actuators rotor control faulttolerance scenarios",
    "design": "core control scenarios campaign",
    "app": "core effects scenarios discovery campaign analysis design faulttolerance",
    "bench": "core actuators rotor control fdd faulttolerance effects scenarios discovery",
}
# What runs in the controller may not look at the true fault, only at what it measures.
BANNED = {"fdd": ["actuators/coil_fault.h"], "faulttolerance": ["actuators/coil_fault.h"]}
# One door per library: the only files that may include it.
DOORS = {
    "toml++/": ["core/base/toml_node.h"],
    "core/base/toml_node.h": ["core/base/toml.cc", "core/base/toml_lists.cc", "core/base/toml_nesting.cc", "core/base/toml_edit.cc"],
    "hdf5.h": ["core/record/hdf5.cc"],
    "matio.h": ["core/record/mat.cc"],
    "ode/": ["rotor/ode_world.cc"],
    "oneapi/tbb": ["campaign/run_rows.cc", "app/commands/check.cc", "discovery/model.cc", "discovery/screen.cc"],
    "ceres/": ["discovery/fit.cc"],
    "muParser": ["effects/formula_parser.cc"],
    "nlopt": ["design/nlopt_search.cc"],
}


def main():
    bad = []
    for folder, allowed in MAY_INCLUDE.items():
        known = {folder, *allowed.split()}
        for file in sorted(pathlib.Path(folder).rglob("*.[hc]*")):
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = re.match(r'\s*#include ["<](([\w.+-]+)/?[^">]*)[">]', line)
                if not match:
                    continue
                path, first = match[1], match[2]
                if '"' in line and first not in known:
                    bad.append(f"{file}:{number}: {folder} may not include from {first}")
                if path in BANNED.get(folder, []):
                    bad.append(f"{file}:{number}: {folder} may not see {path}")
                for library, doors in DOORS.items():
                    if path.startswith(library) and str(file) not in doors:
                        bad.append(f"{file}:{number}: only {', '.join(doors)} may include {path}")
    print("\n".join(bad))
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
