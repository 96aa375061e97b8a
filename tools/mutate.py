#!/usr/bin/env python3
"""Mutation run: how many small mistakes in the sources do the tests of the same folder notice?

    python3 tools/mutate.py --folders fdd,rotor --count 30 --seed 1 --build build/release --work build/mutants

Every mutant is one change at a random place of a .cc file: a relational, boundary, logical or arithmetic operator, a number,
or a statement left out. All of them are compiled into one set of test programs, each behind a switch that the environment
variable AMBRIG_MUTANT turns on (mutation/switches.py); a mutant that does not compile is replaced by another one. A healthy
run of every test, in a process of its own, writes down which mutants it reaches, and a mutant meets only those tests: quick
ones of its own room first, slow ones last, the first failure ends it. --also names test programs of other folders for what
those of its own folder miss. It is killed when a test fails, crashes or takes
--patience times the CPU time of the healthy run (and 10 s more). Each survivor is a missing test, or equivalent to the
original (say why where the figure is reported).

--work holds all that is made. A second call with the same folder goes on where the first one ended; after tests were added
and built, --again judges the survivors anew. Needs python3-clang-16 (tools/setup.sh --tidy) and a build with the test
programs (cmake --build build/release --target test_fdd ...), unity or not; the build stays as it is.
"""
import argparse
import concurrent.futures
import hashlib
import itertools
import json
import pathlib
import shlex
import sys
import threading

from mutation import self_test, switches
from mutation.programs import Build, error_lines
from mutation.sites import Mutant, drawn, sites
from mutation.suite import Suite

ROOT = pathlib.Path(__file__).resolve().parent.parent


def tell(text):
    print(text, flush=True)


def digest(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


def found_in(file, rows):
    """The mutants of these rows in a source that has changed since; those whose line is another one are gone."""
    here, out = [Mutant(ROOT, file, *s) for s in sites(file.read_text())] if file.exists() else [], []
    for row in rows:
        same = [m for m in here if all(m.row("")[k] == row[k] for k in ("kind", "before", "after"))]
        for m in sorted(same, key=lambda m: abs(m.line - row["line"]))[:1]:
            m.number = row["number"]
            out.append(m)
    tell(f"{file.relative_to(ROOT)} has changed: {len(out)} of its {len(rows)} mutants are still there")
    return out


class Work:
    """The folder that a mutation run works in."""

    def __init__(self, options):
        self.folder = (ROOT / options.work).resolve()
        self.folder.mkdir(parents=True, exist_ok=True)
        self.build = Build((ROOT / options.build).resolve(), self.folder, shlex.split(options.prefix))
        self.chosen, self.journal = self.folder / "mutants.json", self.folder / "journal.jsonl"
        self.trees = None
        self.wraps = {}     # file -> wraps that stand in it
        self.declined = []  # rows of mutants that cannot stand

    def switch(self, mutants):
        """Puts switches for the mutants into their sources, in memory."""
        if self.trees is None:
            self.trees = switches.Trees(self.build.clang_arguments())
        missing = sorted({m.file for m in mutants if str(m.file) not in self.trees.top})
        for k in range(0, len(missing), 16):
            tell(f"reading {len(missing[k:k + 16])} sources from {missing[k].relative_to(ROOT)} on")
            self.trees.read(missing[k:k + 16])
        for file in sorted({m.file for m in mutants}):
            known = [w.mutant for w in self.wraps.get(file, [])]
            self.wraps[file], declined = switches.switched(self.trees, file, known + [m for m in mutants if m.file == file])
            self.decline(declined)

    def decline(self, pairs):
        self.declined += [{**m.row("declined"), "why": why} for m, why in pairs]

    def mutants(self):
        return sorted((w.mutant for wraps in self.wraps.values() for w in wraps), key=lambda m: m.number)

    def draw(self, options):
        """Goes on in the random order until `count` mutants stand behind switches."""
        tried = max([m.number for m in self.mutants()] + [row["number"] for row in self.declined], default=0)
        stream = drawn(ROOT, options.folders.split(","), options.seed)
        numbered = itertools.islice(enumerate(stream, 1), tried, None)
        while len(self.mutants()) < options.count:
            while len(self.mutants()) < options.count:
                new = list(itertools.islice(numbered, options.count - len(self.mutants())))
                if not new:
                    sys.exit(f"the folders have no {options.count} mutants")
                for number, mutant in new:
                    mutant.number = number
                self.switch([m for _, m in new])
            self.save()
            self.compile()
        self.save()

    def save(self):
        """Writes the mutants with the extents of their switches and what the sources were like."""
        rows = [{**w.mutant.row(""), "key": w.mutant.key(), "wrap": w.extent(), "digest": digest(w.mutant.file)}
                for wraps in self.wraps.values() for w in wraps]
        rows.sort(key=lambda row: row["number"])
        self.chosen.write_text(json.dumps({"mutants": rows, "declined": self.declined}, indent=0))

    def find_again(self):
        """The mutants of an earlier call: as they were where the source is the same, else found by their line."""
        known = json.loads(self.chosen.read_text())
        self.declined = known["declined"]
        changed = {}
        for row in known["mutants"]:
            file = ROOT / row["file"]
            if not file.exists() or digest(file) != row["digest"]:
                changed.setdefault(file, []).append(row)
                continue
            _, kind, first, last, new = row["key"]
            mutant = Mutant(ROOT, file, kind, first, last, new)
            mutant.number = row["number"]
            self.wraps.setdefault(file, []).append(switches.Wrap(mutant, *row["wrap"]))
        self.switch([m for file, rows in changed.items() for m in found_in(file, rows)])
        self.save()
        self.compile()

    def compile(self):
        """Compiles what has changed; mutants that the compiler does not take are declined."""
        sources = [f for f, wraps in self.wraps.items() if wraps]
        for target, files in self.build.units_of(sources).items():
            while not self.up_to_date(target, files):
                mutated = {f: self.written(pathlib.Path(f)) for f in files if self.wraps[pathlib.Path(f)]}
                tell(f"compiling {target}")
                errors = self.build.compile_unit(target, mutated) if mutated else None
                if errors is None:
                    break
                self.drop(errors, mutated)

    def written(self, file):
        out = self.folder / "sources" / file.relative_to(ROOT)
        out.parent.mkdir(parents=True, exist_ok=True)
        text = switches.with_switches(file.read_text(), self.wraps[file])
        if not out.exists() or out.read_text() != text:
            out.write_text(text)
        return out

    def up_to_date(self, target, files):
        out, original = self.folder / "objects" / target, self.build.folder / target
        inputs = [self.written(pathlib.Path(f)) for f in files] + [original]
        return out.exists() and all(p.stat().st_mtime <= out.stat().st_mtime for p in inputs)

    def drop(self, errors, mutated):
        before = len(self.declined)
        for original, file in mutated.items():
            source = pathlib.Path(original)
            lines, text = error_lines(errors, file), source.read_text()
            hit = lambda w: any(a <= line <= b for a, b in [switches.lines_of(text, w)] for line in lines)
            self.decline([(w.mutant, "does not compile behind a switch") for w in self.wraps[source] if hit(w)])
            self.wraps[source] = [w for w in self.wraps[source] if not hit(w)]
        if len(self.declined) == before:  # an error of the compiler's own names only sources
            for original, file in mutated.items():
                if str(file) in errors:
                    source = pathlib.Path(original)
                    self.decline([(w.mutant, "the compiler fails on its source") for w in self.wraps[source]])
                    self.wraps[source] = []
        if len(self.declined) == before:
            sys.exit(f"the compiler takes none of it:\n{errors[:4000]}")

    def programs(self):
        return sorted({"test_" + m.name.split("/")[0] for m in self.mutants()})

    def link(self, also):
        objects = set(self.build.units_of([f for f, wraps in self.wraps.items() if wraps]))
        self.build.link(self.programs() + also, objects, max(m.number for m in self.mutants()))

    def suites(self, programs, pool):
        out = {}
        for program in programs:
            out[program] = Suite(ROOT, self.folder / program, self.folder / (program + ".json"))
            out[program].measure(tell, pool)
        return out

    def verdicts(self):
        """number -> last row of the journal."""
        lines = self.journal.read_text().splitlines() if self.journal.exists() else []
        return {row["number"]: row for row in map(json.loads, lines)}


def report(work, out):
    known = work.verdicts()
    rows = [known[m.number] for m in work.mutants() if m.number in known]
    dead = sum(r["status"] == "killed" for r in rows)
    share = 100 * dead / len(rows) if rows else 0
    declined = json.loads(work.chosen.read_text())["declined"]
    lines = [f"{dead} of {len(rows)} mutants killed ({share:.1f} %); {len(declined)} drawn anew", "",
             "| folder | mutants | killed |", "|---|---|---|"]
    for folder in sorted({r["file"].split("/")[0] for r in rows}):
        own = [r for r in rows if r["file"].split("/")[0] == folder]
        lines.append(f"| `{folder}` | {len(own)} | {sum(r['status'] == 'killed' for r in own)} |")
    lines += ["", "| no | survivor | kind | original | mutant |", "|---|---|---|---|---|"]
    for r in rows:
        if r["status"] == "survived":
            cells = [c.strip().replace("|", "\\|") for c in (r["before"], r["after"])]
            lines.append(f"| {r['number']} | {r['file']}:{r['line']} | {r['kind']} | `{cells[0]}` | `{cells[1]}` |")
    text = "\n".join(lines) + "\n"
    print(text)
    if out:
        pathlib.Path(out).write_text(text)


def judge_all(work, options, pool):
    """Judges what is asked for, and writes every verdict into the journal."""
    suites, others = work.suites(work.programs(), pool), work.suites(options.also, pool)
    known, lock = work.verdicts(), threading.Lock()
    only = {int(n) for n in options.only.split(",")} if options.only else None

    def one(mutant):
        own = suites["test_" + mutant.name.split("/")[0]]
        for suite in [own, *others.values()]:
            status, by, seconds = suite.judge(mutant, options.patience)
            if status == "killed":
                break
        if status == "killed" and suite is not own:
            by = f"{suite.program.name}: {by}"
        with lock, work.journal.open("a") as file:
            file.write(json.dumps({**mutant.row(status), "by": by, "seconds": seconds}) + "\n")
            tell(f"{mutant.number} {status} {seconds} s {mutant.name}:{mutant.line} {mutant.kind}: "
                 f"{mutant.after.strip()} ({by})")

    def wanted(mutant):
        status = known.get(mutant.number, {}).get("status")
        return mutant.number in only if only else status is None or (options.again and status == "survived")

    cost = lambda m: suites["test_" + m.name.split("/")[0]].cost(m)
    list(pool.map(one, sorted(filter(wanted, work.mutants()), key=cost)))  # what is cheap to know first


def parsed():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--folders", default="fdd,faulttolerance,discovery,rotor")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--work", default="build/mutants", help="folder of all that is made; a later call goes on there")
    parser.add_argument("--also", type=lambda text: text.split(","), default=[],
                        help="test programs of other folders that a mutant meets which its own one missed")
    parser.add_argument("--patience", type=float, default=5, help="limit of CPU time over the healthy run")
    parser.add_argument("--prefix", default="", help="command before compilers, e.g. nice")
    parser.add_argument("--jobs", type=int, default=1, help="tests that run side by side")
    parser.add_argument("--again", action="store_true", help="judge the survivors of the journal anew")
    parser.add_argument("--only", help="numbers of the mutants to judge, with commas")
    parser.add_argument("--out", help="write the table to this file")
    parser.add_argument("--prepare", action="store_true", help="draw, compile and link only")
    parser.add_argument("--self-test", action="store_true", help="compare switches with plain mutants of a small program")
    parser.add_argument("--list", action="store_true", help="show the random order of mutants, run nothing")
    return parser.parse_args()


def main():
    options = parsed()
    if options.self_test:
        return self_test.run()
    if options.list:
        for k, m in zip(range(options.count), drawn(ROOT, options.folders.split(","), options.seed)):
            print(f"{k + 1} {m.name}:{m.line}: {m.kind}: {m.before.strip()}  ->  {m.after.strip()}")
        return 0
    work = Work(options)
    if work.chosen.exists():
        work.find_again()
    if not options.again:
        work.draw(options)
    work.link(options.also)
    if options.prepare:
        return 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        judge_all(work, options, pool)
    report(work, options.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
