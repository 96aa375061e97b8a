"""The rotors of ROSS's notebooks, for ross_examples.py. Of a notebook only the statements that can build a rotor are run.
A notebook that is not in the checkout at hand (copies may lack its largest files) is taken in the newest version that the
checkout's history holds; of those that are in no version at hand, the rotors that their own text states are built here."""
import ast
import contextlib
import io
import json
import os
import pathlib
import re
import subprocess
import traceback

NO_BUILDING = re.compile(r"run_|\.plot|\.show|Report|ST_|time_response|convergence|\bfig|\bplt\b|print\(")
EARLIER_NAMES = {"tutorial_part_1_2": "tutorial_part_1", "tutorial_part_3": "tutorial_part_3"}
BODIES = (ast.For, ast.If, ast.With, ast.While, ast.Try)


def building(statements, within=False):
    """What can be part of building a rotor, without what analyses or draws; loops and functions are gone through, and
    within them what needs a statement that is left out fails by itself."""
    out = []
    for s in statements:
        if isinstance(s, BODIES) or isinstance(s, ast.FunctionDef):
            s.body = building(s.body, True) or [ast.Pass()]
            for part in ("orelse", "finalbody"):
                if getattr(s, part, None):
                    setattr(s, part, building(getattr(s, part), True))
            out.append(tried(s) if within else s)
        elif isinstance(s, (ast.Return, ast.Break, ast.Continue)):
            out.append(s)
        elif not NO_BUILDING.search(ast.unparse(s)):
            out.append(tried(s) if within else s)
    return out


def tried(statement):
    handler = ast.ExceptHandler(ast.Name("Exception", ast.Load()), None, [ast.Pass()])
    return ast.Try([statement], [handler], [], [])


def run(recorder, name, text):
    recorder.place = name
    space = {"__name__": "notebook"}
    for cell in json.loads(text)["cells"]:
        if cell["cell_type"] != "code":
            continue
        lines = "".join(cell["source"]).splitlines(True)
        try:
            tree = ast.parse("".join(line for line in lines if not line.lstrip().startswith(("%", "!"))))
        except SyntaxError:
            continue
        for statement in building(tree.body):
            module = ast.fix_missing_locations(ast.Module([statement], []))
            try:
                with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
                    exec(compile(module, name, "exec"), space)
            except Exception as e:
                if "Rotor" in ast.unparse(statement) or "Element" in ast.unparse(statement):
                    recorder.log(f"{name}: {type(e).__name__}: {str(e)[:120]} in {ast.unparse(statement)[:80]}")


def git(checkout, *arguments):
    done = subprocess.run(["git", "-C", str(checkout), *arguments], capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else ""


def from_history(checkout, path):
    """(text, date) of the newest version in any commit that the checkout can still read, ("", "") without any."""
    earlier = EARLIER_NAMES.get(pathlib.Path(path).stem)
    folders = ("docs/user_guide", "docs/tutorials", "docs/examples") if earlier else ()
    for place in [path] + [f"{folder}/{earlier}.ipynb" for folder in folders]:
        for commit in git(checkout, "log", "--all", "--full-history", "--format=%H", "--", place).split():
            text = git(checkout, "show", f"{commit}:{place}")
            if text:
                return text, git(checkout, "log", "-1", "--format=%as", commit).strip()
    return "", ""


def stated(ross):
    """The rotors that these notebooks state in words and parameters (their first cells)."""
    def shaft(material, n, length, od):
        return [ross.ShaftElement(L=length / n, idl=0, odl=od, material=material) for _ in range(n)]

    def bearing(n, kxx, kyy, cxx, cyy):
        return ross.BearingElement(n=n, kxx=kxx, kyy=kyy, cxx=cxx, cyy=cyy)

    def rigid(*ends):
        steel = ross.Material(name="Steel", rho=7810, E=211e9, G_s=81.2e9)
        return ross.Rotor(shaft(steel, 5, 0.5, 0.2), [], [bearing(0, *ends[0]), bearing(5, *ends[1])])

    def two_disks(shear_modulus, damping):
        steel = ross.Material(name="Steel", rho=7810, E=211e9, G_s=shear_modulus)
        disks = [ross.DiskElement.from_geometry(n, steel, 0.07, 0.05, od) for n, od in ((2, 0.28), (4, 0.35))]
        ends = [bearing(n, 1e6, 1e6, damping, damping) for n in (0, 6)]
        return ross.Rotor(shaft(steel, 6, 1.5, 0.05), disks, ends)

    return {
        "example_26": [lambda: two_disks(81.1e9, 100.0)],
        "example_28": [lambda: rigid((1e6, 1e6, 10.0, 10.0), (1.3e6, 1.3e6, 13.0, 13.0))],
        "example_29": [lambda: rigid((1e6, 1.5e6, 20.0, 30.0), (1.3e6, 1.8e6, 26.0, 36.0))],
        "example_30": [lambda: rigid((1e6, 1e6, 0.0, 0.0), (1.3e6, 1.3e6, 0.0, 0.0)),
                       lambda: rigid((1e6, 1.1e6, 0.0, 0.0), (1.3e6, 1.4e6, 0.0, 0.0))],
        "example_31": [lambda: two_disks(81.2e9, 3e3)],
    }


def run_all(recorder, checkout):
    listed = git(checkout, "ls-tree", "-r", "--name-only", "HEAD", "docs").split()
    there = [str(p.relative_to(checkout)) for p in (checkout / "docs").rglob("*.ipynb")]
    back = os.getcwd()
    words = stated(recorder.ross)
    for path in sorted({p for p in listed if p.endswith(".ipynb")} | set(there)):
        file, name, remark = checkout / path, pathlib.Path(path).stem, ""
        text = file.read_text() if file.exists() else ""
        if not text:
            text, date = from_history(checkout, path)
            remark = f"not in the checkout, version of {date}"
        os.chdir(file.parent)
        before = len(recorder.found)
        try:
            if text:
                run(recorder, name, text)
            elif name in words:
                remark = "not in the checkout, built from its text"
                recorder.place = name
                for make in words[name]:
                    make()
            else:
                remark = "not in the checkout, in no version of its history"
        except Exception:
            recorder.log(f"{name}: {traceback.format_exc(limit=1)}")
        os.chdir(back)
        recorder.notebooks.append((name, remark, len(recorder.found) - before, list(recorder.copies.get(name, {}))))
