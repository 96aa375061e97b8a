#!/usr/bin/env python3
"""All rotors that a checkout of ROSS (petrobras/ross) ships: those that its `*_example` functions give, those that its
tests build, and those of its notebooks (tools/ross_notebooks.py). Each class of rotor is watched while that code runs,
so that none has to be listed here; what only differs by a copy is taken once. Needs ROSS's own requirements, no ambrig."""
import ast
import importlib
import inspect
import io
import pathlib
import contextlib
import sys

import ross_notebooks


class Recorder:
    """Rotors by the place that built them first."""

    def __init__(self, ross, log):
        self.ross, self.log = ross, log
        self.place, self.found, self.seen = "", [], {}
        self.notebooks = []  # (name, remark, rotors that are new, places of those that it builds again)
        self.copies = {}  # place: the places whose rotor it builds again
        self.quiet = False
        for kind in (ross.Rotor, ross.CoAxialRotor, ross.MultiRotor):
            self.watch(kind)

    def watch(self, kind):
        original = kind.__init__

        def init(rotor, *args, **kwargs):
            original(rotor, *args, **kwargs)
            if type(rotor) is kind:
                self.add(rotor)

        kind.__init__ = init

    def add(self, rotor):
        if self.quiet or not self.place:
            return
        key = identity(rotor)
        if key in self.seen:
            self.copies.setdefault(self.place, {})[self.seen[key]] = None
            return
        count = sum(1 for place, _ in self.found if place.split("#")[0] == self.place)
        self.seen[key] = self.place + (f"#{count + 1}" if count else "")
        self.found.append((self.seen[key], rotor))


def identity(rotor):
    shafts = [len(s) for s in getattr(rotor, "shafts", [])]
    return str((type(rotor).__name__, shafts, [repr(e.__dict__.get("tag")) + fingerprint(e) for e in rotor.elements]))


def fingerprint(element):
    names = ("n", "n_link", "L", "idl", "odl", "idr", "odr", "axial_force", "torque", "m", "mx", "my", "Id", "Ip", "kxx", "kyy", "kxy", "cxx", "cyy", "mxx")
    return str([(k, str(element.__dict__[k])[:80]) for k in names if k in element.__dict__])


def run_examples(recorder, package):
    for path in sorted(pathlib.Path(package).rglob("*.py")):
        if {"tests", "stochastic", "bearings", "seals"} & set(path.parts):  # whose examples are parts, not rotors
            continue
        name = ".".join(path.relative_to(pathlib.Path(package).parent).with_suffix("").parts)
        names = [n.name for n in ast.parse(path.read_text()).body if isinstance(n, ast.FunctionDef) and "example" in n.name]
        for function in names:
            recorder.place = f"{path.stem}.{function}"
            call(recorder, getattr(importlib.import_module(name), function))


def run_tests(recorder, package):
    """Fixtures and helpers without required arguments; tests themselves are not run."""
    for path in sorted((pathlib.Path(package) / "tests").glob("test_*.py")):
        if "stochastic" in path.name:
            continue
        recorder.place = ""
        try:
            module = importlib.import_module(f"ross.tests.{path.stem}")
        except Exception as e:  # a requirement of the tests alone
            recorder.log(f"{path.name}: {e}")
            continue
        for name, function in list(vars(module).items()):
            function = getattr(function, "__wrapped__", None) or getattr(getattr(function, "__pytest_wrapped__", None), "obj", function)
            if not inspect.isfunction(function) or name.startswith("test_") or function.__module__ != module.__name__:
                continue
            recorder.place = f"{path.stem}.{name}"
            call(recorder, function)


def call(recorder, function):
    required = [p for p in inspect.signature(function).parameters.values() if p.default is p.empty]
    if required:
        return
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            function()
    except Exception as e:
        recorder.log(f"{recorder.place}: {type(e).__name__}: {str(e)[:120]}")


def collect(checkout, log=lambda text: None):
    """Every rotor as (name, rotor), and the notebooks as in Recorder; `checkout` holds ross/ and docs/."""
    checkout = pathlib.Path(checkout).resolve()
    sys.path.insert(0, str(checkout))
    import ross
    recorder = Recorder(ross, log)
    run_examples(recorder, checkout / "ross")
    run_tests(recorder, checkout / "ross")
    ross_notebooks.run_all(recorder, checkout)
    recorder.quiet = True
    return recorder.found, recorder.notebooks


if __name__ == "__main__":
    rotors, notebooks = collect(sys.argv[1], lambda text: print("  " + text))
    for name, rotor in rotors:
        print(name, type(rotor).__name__, len(rotor.elements))
    for notebook in notebooks:
        print(*notebook)
