#!/usr/bin/env python3
"""Mutation run: how many small mistakes in the sources do the tests of the same folder notice?

    python3 tools/mutate.py --folders fdd,rotor --count 30 --seed 1 --build build/release --out mutants.md

Every mutant is one change at a random place of a .cc file: a relational, boundary, logical or arithmetic
operator, a number, or a statement left out. Its object is compiled into a scratch folder with the command
of the build and linked before the folder's library into the folder's test program; the sources and the
build stay as they are. The mutant is killed when the program fails, crashes or takes longer than
--patience times the healthy run; one that does not compile does not count. Prints and writes a table of
the survivors: each is a missing test, or equivalent to the original (say why in docs/validation of the
change). The build must hold the test programs (cmake --build ... --target test_FOLDER).
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
import time

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
        command += ["-O1", "-w"]
        done = subprocess.run(command, cwd=self.folder, capture_output=True)
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


def passes(program, limit, filters):
    """Whether the tests pass within `limit` seconds, and how long they took."""
    began = time.monotonic()
    try:
        done = subprocess.run([str(program), "--gtest_brief=1", "--gtest_fail_fast", *filters], cwd=ROOT,
                              capture_output=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return False, limit
    return done.returncode == 0, time.monotonic() - began


def line_of(text, first):
    return text.count("\n", 0, first) + 1


def report(rows, out):
    counted = [r for r in rows if r[0] != "invalid"]
    killed = sum(r[0] == "killed" for r in counted)
    share = 100 * killed / len(counted) if counted else 0
    lines = [f"{killed} of {len(counted)} mutants killed ({share:.0f} %), "
             f"{len(rows) - len(counted)} did not compile", "", "| survivor | kind | original | mutant |", "|---|---|---|---|"]
    for status, file, line, kind, before, after in rows:
        if status == "survived":
            cells = [c.strip().replace("|", "\\|") for c in (before, after)]
            lines.append(f"| {file}:{line} | {kind} | `{cells[0]}` | `{cells[1]}` |")
    text = "\n".join(lines) + "\n"
    print(text)
    if out:
        pathlib.Path(out).write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--folders", default="fdd,faulttolerance,discovery,rotor")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--patience", type=float, default=3, help="time limit over the healthy run")
    parser.add_argument("--filter", default="", help="--gtest_filter of the test programs")
    parser.add_argument("--out", help="write the table to this file")
    parser.add_argument("--list", action="store_true", help="show the mutants, run nothing")
    o = parser.parse_args()
    mutants = choose(o.folders.split(","), o.count, o.seed)
    filters = [f"--gtest_filter={o.filter}"] if o.filter else []
    rows, healthy = [], {}
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        build = None if o.list else Build((ROOT / o.build).resolve(), scratch)
        for k, (file, kind, first, last, new) in enumerate(mutants):
            text = file.read_text()
            name, at = str(file.relative_to(ROOT)), line_of(text, first)
            changed = text[:first] + new + text[last:]
            before, after = text.split("\n")[at - 1], changed.split("\n")[at - 1]
            if o.list:
                print(f"{name}:{at}: {kind}: {before.strip()}  ->  {after.strip()}")
                continue
            program = "test_" + name.split("/")[0]
            if program not in healthy:
                ok, healthy[program] = passes(build.folder / program, 3600, filters)
                if not ok:
                    sys.exit(f"{program} fails without a mutant")
            mutated = scratch / file.name
            mutated.write_text(changed)
            mutant = build.compile_mutant(file, mutated)
            status = "invalid"
            if mutant:
                ok, _ = passes(build.link(program, mutant), 5 + o.patience * healthy[program], filters)
                status = "survived" if ok else "killed"
            rows.append((status, name, at, kind, before, after))
            print(f"{k + 1}/{len(mutants)} {status:9s} {name}:{at} {kind}: {after.strip()}", flush=True)
    if not o.list:
        report(rows, o.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
