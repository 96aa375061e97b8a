#!/usr/bin/env python3
"""All rotors that a checkout of ROSS (petrobras/ross) ships: those that its `*_example` functions give, those that its
tests build, and those of its notebooks. Each class of rotor is watched while that code runs, so that none has to be
listed here; what only differs by a copy is taken once. Needs ROSS's own requirements, no ambrig."""
import ast
import importlib
import inspect
import io
import json
import pathlib
import contextlib
import sys
import traceback


class Recorder:
    """Rotors by the place that built them first."""

    def __init__(self, ross, log):
        self.ross, self.log = ross, log
        self.place, self.found, self.seen = "", [], set()
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
        with contextlib.suppress(Exception):
            shafts = [len(s) for s in getattr(rotor, "shafts", [])]
            key = str((type(rotor).__name__, shafts, [repr(e.__dict__.get("tag")) + fingerprint(e) for e in rotor.elements]))
            if key in self.seen:
                return
            self.seen.add(key)
        count = sum(1 for place, _ in self.found if place.split("#")[0] == self.place)
        self.found.append((self.place + (f"#{count + 1}" if count else ""), rotor))


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


def of_building(statement):
    """Whether a statement of a notebook can be part of building a rotor, not of analysing or drawing it."""
    text = ast.unparse(statement)
    return not any(word in text for word in ("run_", ".plot", ".show", "Report", "ST_", "time_response", "convergence", "fig", "plt", "print("))


def run_notebook(recorder, path):
    recorder.place = path.stem
    space = {"__name__": "notebook"}
    for cell in json.loads(path.read_text())["cells"]:
        if cell["cell_type"] != "code":
            continue
        text = "".join(line for line in cell["source"] if not line.lstrip().startswith(("%", "!")))
        try:
            tree = ast.parse(text)
        except SyntaxError:
            continue
        for statement in tree.body:
            if not of_building(statement):
                continue
            try:
                with contextlib.redirect_stdout(io.StringIO()):
                    exec(compile(ast.Module([statement], []), path.name, "exec"), space)
            except Exception as e:
                if "Rotor" in ast.unparse(statement) or "Element" in ast.unparse(statement):
                    recorder.log(f"{path.name}: {type(e).__name__}: {str(e)[:120]} in {ast.unparse(statement)[:80]}")


def collect(checkout, log=lambda text: None, only=""):
    """[(name, rotor)] of those whose name holds `only`; `checkout` holds ross/ and docs/."""
    checkout = pathlib.Path(checkout).resolve()
    sys.path.insert(0, str(checkout))
    import ross
    recorder = Recorder(ross, log)
    run_examples(recorder, checkout / "ross")
    run_tests(recorder, checkout / "ross")
    import os
    back = os.getcwd()
    for path in sorted((checkout / "docs").rglob("*.ipynb")):
        if path.stat().st_size == 0:
            log(f"{path.name}: empty")
            continue
        os.chdir(path.parent)
        try:
            run_notebook(recorder, path)
        except Exception:
            log(f"{path.name}: {traceback.format_exc(limit=1)}")
        os.chdir(back)
    recorder.quiet = True
    return [(name, rotor) for name, rotor in recorder.found if only in name]


if __name__ == "__main__":
    for name, rotor in collect(sys.argv[1], lambda text: print("  " + text)):
        print(name, type(rotor).__name__, len(rotor.elements))
