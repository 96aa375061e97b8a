#!/usr/bin/env python3
"""Mutation run: how many small mistakes in the sources do the tests of the same folder notice?

    python3 tools/mutate.py --folders fdd,rotor --count 30 --seed 1 --build build/separate --out mutants.md

Every mutant is one change at a random place of a .cc file: a relational, boundary, logical or arithmetic
operator, a number, or a statement left out. Its object is compiled into a scratch folder with the command
of the build and linked before the folder's library into the folder's test program; the sources and the
build stay as they are. The tests of the mutant's own room come first, slow ones last, and the first failure
ends them. The mutant is killed when the program fails, crashes or takes longer than --patience times the
healthy run; one that does not compile does not count. Prints and writes a table of the survivors: each is a
missing test, or equivalent to the original (say why where the figure is reported). The build must compile one source at a
time (cmake --preset separate) and hold the test programs (cmake --build ... --target test_FOLDER).
"""
import argparse
import json
import os
import pathlib
import random
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SWAPS = {
    "relational": {"<": ">=", ">": "<=", "<=": ">", ">=": "<", "==": "!=", "!=": "=="},
    "boundary": {"<": "<=", ">": ">=", "<=": "<", ">=": ">"},
    "logical": {"&&": "||", "||": "&&"},
    "arithmetic": {"+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="},
}
NUMBER = re.compile(r"(?<![\w.\[])(\d+\.\d+(?:e[+-]?\d+)?|\d+e[+-]?\d+|\d+)(?![\w.])")
STATEMENT = re.compile(r"^\s+(?!return\b|break\b|continue\b|using\b|case\b|delete\b|throw\b)"
                       r"(?:[\w.>\[\]:()*-]+ [-+*/|&]?= [^;{}]*|\+\+[\w.\[\]]+|[\w.>:-]+\([^;{}]*\));$")


def masked(text):
    """The text with comments, strings, characters and preprocessor lines as blanks of the same length."""
    blank = lambda m: re.sub(r"[^\n]", " ", m.group(0))
    pattern = r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)\'|^[ \t]*#[^\n]*'
    return re.sub(pattern, blank, text, flags=re.S | re.M)


def sites(text):
    """(kind, first, last, replacement) of every possible mutant of a source."""
    bare, out = masked(text), []
    for kind, swaps in SWAPS.items():
        for m in re.finditer(r"(?<= )(<=|>=|==|!=|&&|\|\||\+=|-=|\*=|/=|<|>|\+|-|\*|/)(?= )", bare):
            if m[1] in swaps:
                out.append((kind, m.start(1), m.end(1), swaps[m[1]]))
    for m in NUMBER.finditer(bare):
        value = m[1]
        new = str(int(value) + 1) if value.isdigit() else f"({value} * 1.5)"
        out.append(("constant", m.start(1), m.end(1), new if value not in ("0.0",) else "0.5"))
    at, before = 0, "{"
    for line in bare.split("\n"):
        if STATEMENT.match(line) and before[-1] in ";{}":  # not the end of a statement of several lines
            first = at + len(line) - len(line.lstrip())
            out.append(("statement", first, at + len(line), ";"))
        at += len(line) + 1
        before = line.rstrip() or before
    return out


def choose(folders, count, seed):
    """`count` mutants: (file, kind, first, last, replacement), each place equally likely, no place twice."""
    pool = []
    for folder in folders:
        for file in sorted((ROOT / folder).rglob("*.cc")):
            pool += [(file, *s) for s in sites(file.read_text())]
    return random.Random(seed).sample(pool, min(count, len(pool)))


class Build:
    """Compile and link commands of an existing build."""

    def __init__(self, folder, scratch):
        self.folder, self.scratch = folder, scratch
        entries = json.loads((folder / "compile_commands.json").read_text())
        self.compile = {os.path.realpath(e["file"]): shlex.split(e["command"]) for e in entries}
        self.links = {}

    def compile_mutant(self, original, mutated):
        """The object of the mutated source, or None where it does not compile."""
        command = list(self.compile[os.path.realpath(original)])
        if command[0].endswith("ccache"):
            command = command[1:]
        target = self.scratch / "mutant.o"
        command[command.index("-o") + 1] = str(target)
        command[-1] = str(mutated)
        done = subprocess.run([*command, "-w"], cwd=self.folder, capture_output=True)
        return target if done.returncode == 0 else None

    def link_command(self, program):
        if program not in self.links:
            text = subprocess.run(["ninja", "-t", "commands", program], cwd=self.folder, check=True,
                                  capture_output=True, text=True).stdout.strip().split("\n")[-1]
            line = re.sub(r"^: && | && :$", "", text).split(" && ")[0]
            self.links[program] = shlex.split(line)
        return list(self.links[program])

    def link(self, program, mutant):
        command = self.link_command(program)
        target = self.scratch / program
        at = command.index("-o")
        command[at + 1] = str(target)
        command.insert(at, str(mutant))
        subprocess.run(command, cwd=self.folder, check=True, capture_output=True)
        return target


class Suite:
    """The tests of a program in the order in which a mutant meets them: quick ones of the mutant's own room,
    other quick ones, slow ones of the room, the rest."""

    QUICK = 0.3  # [s]

    def __init__(self, program, scratch, pattern):
        """Runs the healthy program once; `scratch` keeps what it said for later calls."""
        out = scratch / (program.name + ".json")
        if not out.exists():
            done = subprocess.run([str(program), f"--gtest_output=json:{out}",
                                   *([f"--gtest_filter={pattern}"] if pattern else [])], cwd=ROOT, capture_output=True)
            if done.returncode != 0:
                out.unlink(missing_ok=True)
                sys.exit(f"{program.name} fails without a mutant")
        self.tests = []  # (name, folder of its file, seconds)
        for suite in json.loads(out.read_text())["testsuites"]:
            for test in suite["testsuite"]:
                room = pathlib.Path(os.path.relpath(os.path.join(program.parent, test["file"]), ROOT)).parent
                self.tests.append((f"{suite['name']}.{test['name']}", room.as_posix(), float(test["time"][:-1])))

    def phases(self, source):
        """(tests, seconds of the healthy run) of every phase for a mutant of this source."""
        room = "tests/" + pathlib.PurePath(source).parent.as_posix()
        own = lambda t: t[1] == room or t[1].startswith(room + "/")
        parts = [[], [], [], []]
        for t in self.tests:
            parts[(0 if own(t) else 1) + (0 if t[2] < self.QUICK else 2)].append(t)
        return [([t[0] for t in part], sum(t[2] for t in part)) for part in parts if part]


def killed(program, phases, patience):
    """Whether some test notices the mutant."""
    for tests, seconds in phases:
        try:
            done = subprocess.run([str(program), "--gtest_brief=1", "--gtest_fail_fast",
                                   "--gtest_filter=" + ":".join(tests)], cwd=ROOT, capture_output=True,
                                  timeout=10 + patience * seconds)
        except subprocess.TimeoutExpired:
            return True
        if done.returncode != 0:
            return True
    return False


def line_of(text, first):
    return text.count("\n", 0, first) + 1


def report(rows, out):
    counted = [r for r in rows if r["status"] != "invalid"]
    dead = sum(r["status"] == "killed" for r in counted)
    share = 100 * dead / len(counted) if counted else 0
    lines = [f"{dead} of {len(counted)} mutants killed ({share:.0f} %), "
             f"{len(rows) - len(counted)} did not compile", "",
             "| survivor | kind | original | mutant |", "|---|---|---|---|"]
    for r in rows:
        if r["status"] == "survived":
            cells = [c.strip().replace("|", "\\|") for c in (r["before"], r["after"])]
            lines.append(f"| {r['file']}:{r['line']} | {r['kind']} | `{cells[0]}` | `{cells[1]}` |")
    text = "\n".join(lines) + "\n"
    print(text)
    if out:
        pathlib.Path(out).write_text(text)


class Mutant:
    def __init__(self, file, kind, first, last, new):
        self.file, self.kind = file, kind
        self.name = str(file.relative_to(ROOT))
        text = file.read_text()
        self.text = text[:first] + new + text[last:]
        self.line = line_of(text, first)
        self.before, self.after = (t.split("\n")[self.line - 1] for t in (text, self.text))

    def row(self, status):
        return {"status": status, "file": self.name, "line": self.line, "kind": self.kind,
                "before": self.before, "after": self.after}

    def same(self, row):
        return all(self.row("")[key] == row[key] for key in ("file", "kind", "before", "after"))


def judge(mutant, options, scratch):
    """killed, survived or invalid."""
    build = Build((ROOT / options.build).resolve(), scratch)
    program = "test_" + mutant.name.split("/")[0]
    suite = Suite(build.folder / program, scratch, options.filter)
    mutated = scratch / mutant.file.name
    mutated.write_text(mutant.text)
    compiled = build.compile_mutant(mutant.file, mutated)
    if not compiled:
        return "invalid"
    linked = build.link(program, compiled)
    return "killed" if killed(linked, suite.phases(mutant.name), options.patience) else "survived"


def parsed():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--folders", default="fdd,faulttolerance,discovery,rotor")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--build", default="build/separate")
    parser.add_argument("--patience", type=float, default=5, help="time limit over the healthy run")
    parser.add_argument("--filter", default="", help="--gtest_filter of the test programs")
    parser.add_argument("--prefix", default="", help="command that runs the work on each mutant, e.g. nice")
    parser.add_argument("--journal", help="one JSON line per mutant; a run that finds some there goes on after them")
    parser.add_argument("--again", help="judge the survivors of this journal anew instead of choosing mutants")
    parser.add_argument("--out", help="write the table to this file")
    parser.add_argument("--only", type=int, help="judge this mutant alone and print the verdict as JSON")
    parser.add_argument("--scratch", help="folder for objects and programs (default: a temporary one)")
    parser.add_argument("--list", action="store_true", help="show the mutants, run nothing")
    return parser.parse_args()


def survivors(journal):
    """The surviving mutants of a journal, found again in the sources as they are now."""
    rows = [json.loads(line) for line in pathlib.Path(journal).read_text().splitlines()]
    wanted = [r for r in rows if r["status"] == "survived"]
    out = []
    for file in sorted({r["file"] for r in wanted}):
        here = [Mutant(ROOT / file, *s) for s in sites((ROOT / file).read_text())]
        for r in (r for r in wanted if r["file"] == file):
            same = [m for m in here if m.same(r)]
            out += sorted(same, key=lambda m: abs(m.line - r["line"]))[:1]
    return out


def main():
    o = parsed()
    mutants = survivors(o.again) if o.again else [Mutant(*m) for m in choose(o.folders.split(","), o.count, o.seed)]
    if o.list:
        for m in mutants:
            print(f"{m.name}:{m.line}: {m.kind}: {m.before.strip()}  ->  {m.after.strip()}")
        return 0
    if o.only is not None:
        print(json.dumps(mutants[o.only].row(judge(mutants[o.only], o, pathlib.Path(o.scratch)))))
        return 0
    journal = pathlib.Path(o.journal) if o.journal else None
    rows = []
    known = [json.loads(line) for line in journal.read_text().splitlines()] if journal and journal.exists() else []
    with tempfile.TemporaryDirectory() as scratch:
        for k, mutant in enumerate(mutants):
            row = known[k] if k < len(known) and mutant.same(known[k]) else None
            if row is None:
                done = subprocess.run([*shlex.split(o.prefix), sys.executable, *sys.argv, "--only", str(k),
                                       "--scratch", o.scratch or scratch], stdout=subprocess.PIPE, text=True)
                if done.returncode != 0:
                    return done.returncode
                row = json.loads(done.stdout.splitlines()[-1])
                if journal:
                    with journal.open("a") as file:
                        file.write(json.dumps(row) + "\n")
                print(f"{k + 1}/{len(mutants)} {row['status']:9s} {mutant.name}:{mutant.line} {mutant.kind}: "
                      f"{mutant.after.strip()}", flush=True)
            rows.append(row)
    report(rows, o.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
