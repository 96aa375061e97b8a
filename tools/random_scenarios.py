#!/usr/bin/env python3
"""Random valid scenarios: rigs drawn over the ranges of the parameter tables, each run once.

Every number of a rig file is drawn: near that of an example rig, or anywhere in the range that
`ambrig parameters` names for it, and every kind among those that there are (tools/random_draws.py).
What `ambrig` refuses is drawn again with fewer numbers far off, until it is accepted. A run must end
by itself, within a minute of computing, with exit code 0 and with finite numbers only;
its outcome (stayed up, touched down, dropped, beyond the model, no solution) is counted.

Many scenarios go through one process (`ambrig run --keep-going`); a journal holds a line for each
that is finished, and the same command with the same journal goes on where it was stopped.

  tools/random_scenarios.py build/release/ambrig                     100 scenarios, as CI does
  tools/random_scenarios.py build/release/ambrig -n 100000 --journal j.jsonl --minutes 60
  tools/random_scenarios.py build/release/ambrig --summary j.jsonl
  tools/random_scenarios.py build/release/ambrig --only 4711 --keep out

Exit code 1 when a run crashed, hung, ended with a program error or left a number that is none;
its files stay in the folder named (default: random_scenarios).
"""
import argparse
import collections
import concurrent.futures
import json
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time

import random_draws

TIMEOUT = 60  # s of computing of one run
DRAWS = 30  # of one scenario, until one is accepted
MEMORY = 4 << 30  # bytes of one run


# --- one scenario -------------------------------------------------------------------------------
class Draw:
    """A scenario that is drawn until it is accepted; its index is its seed."""

    def __init__(self, index, tables):
        self.index, self.tables = index, tables
        self.rng = random.Random(index)
        self.far = random_draws.draw_far(self.rng)
        # The reference engine takes a second for what the switching one does in a twentieth.
        self.fidelity = self.rng.choices(["switching", "averaged", "reference"], [90, 8, 2])[0]
        self.refusals, self.kind, self.message, self.seconds, self.tags = [], None, "", 0.0, []

    def write(self, folder):
        rig, parts = random_draws.draw_rig(self.rng, self.tables, self.far)
        if parts.stators:
            self.fidelity = "switching"  # the others know no stator of any kind
        scenario = random_draws.draw_scenario(self.rng, rig, parts, self.tables.faults, self.far,
                                                self.fidelity)
        self.tags = tags(rig, scenario)
        scenario["rig"] = f"r{self.index}.toml"
        (folder / f"r{self.index}.toml").write_text(random_draws.toml(rig))
        (folder / self.file).write_text(random_draws.toml(scenario))

    @property
    def file(self):
        return f"s{self.index}.toml"

    def refused(self, message):
        if "could not be integrated" in message or "diverged" in message:
            self.kind = "no solution"
            return
        self.refusals.append(message)
        self.far = self.far.nearer()
        if len(self.refusals) >= DRAWS:
            self.kind, self.message = "never accepted", message

    def line(self):
        reasons = [re.sub(r"-?\d[-+\d.e]*", "#", r.split("toml")[-1])[:70] for r in self.refusals]
        return {"i": self.index, "class": self.kind, "message": self.message, "fidelity": self.fidelity,
                "s": round(self.seconds, 3), "refused": reasons, "tags": self.tags}


def tags(rig, scenario):
    """What kinds a scenario is made of, counted in the summary."""
    found = {"modulation " + rig["amplifier"]["modulation"], "start " + scenario["start"]["state"],
             "controller " + rig["controller"]["kind"], "rotor " + rig["rotor"]["kind"]}
    if rig["amplifier"].get("mode") == "voltage":
        found.add("mode voltage")
    if rig["amplifier"]["modulation"] in ("bi-state", "two-level") and scenario["fault_tolerance"]:
        found.add("detector " + rig.get("detection", {}).get("kind", "as nothing says"))
    for bearing in rig["bearings"].values():
        found.add("bearing " + bearing.get("kind", "radial") + " " + bearing.get("template", ""))
    for name, kind in (("fault", "kind"), ("excitation", "port"), ("effect", "name")):
        found |= {f"{name} {item[kind]}" for item in scenario.get(name, []) + rig.get(name, [])}
    return sorted(tag.strip() for tag in found)


def outcome(out, stem):
    """(class, message) of a run that is over."""
    result = json.loads((out / f"{stem}.json").read_text())
    metrics = {k: v for k, v in result["metrics"].items() if not k.endswith("_delay")}
    numbers = [v for v in metrics.values() if not isinstance(v, dict)]
    numbers += list(metrics["max_orbit"].values())
    if any(v is None or not math.isfinite(v) for v in numbers):
        return "NOT A NUMBER", json.dumps(metrics)
    rows = (out / f"{stem}.csv").read_bytes()
    rows = rows[rows.index(b"\n") + 1:]
    for wrong in (b",,", b",\n", b"nan", b"inf"):
        if wrong in rows:
            return "NOT A NUMBER", f"{stem}.csv: {wrong.decode()!r}"
    if any("model" in note and "invalid" in note for note in result.get("notes", [])):
        return "beyond the model", ""
    return ("dropped" if result["drop"] else
            "touched down" if result["touchdown"] else "stayed up"), ""


# --- many in one process ------------------------------------------------------------------------
class Batch:
    """Draws of one fidelity in one process; who does not answer, crashes or hangs is found."""

    def __init__(self, ambrig, folder, fidelity, draws):
        self.ambrig, self.folder, self.fidelity, self.left = ambrig, folder, fidelity, list(draws)
        self.out, self.computed = folder / "out", 0.0

    def collect(self, errors):
        """Takes over what is finished: a JSON file or a line of the errors for each."""
        for line in errors:
            named = re.match(r"ambrig: (s\d+\.toml|r\d+\.toml)(.*)", line)
            if named:
                index = int(named[1][1:-5])
                for draw in [d for d in self.left if d.index == index]:
                    draw.refused(line)
                    self.left.remove(draw)
        while self.left and (self.out / f"s{self.left[0].index}.json").exists():
            draw = self.left.pop(0)
            draw.kind, draw.message = outcome(self.out, f"s{draw.index}")
            for name in self.out.glob(f"s{draw.index}.*"):
                name.unlink()

    def run(self):
        """Once through what is left; a process that died names its victim, the others go on."""
        while self.left:
            first = list(self.left)
            command = ["prlimit", f"--as={MEMORY}", self.ambrig, "run", *[d.file for d in first], "--keep-going",
                       "--out", "out", "--no-report", "--csv", "--quiet", "--fidelity", self.fidelity]
            with open(self.folder / "errors", "w+") as errors:
                process = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=errors,
                                           env=dict(os.environ, AMBRIG_CACHE=str(self.folder / "cache")))
                hung = self.watch(process)
                for draw in first:
                    draw.seconds += self.computed / len(first)
                errors.seek(0)
                lines = errors.read().splitlines()
            self.collect(lines)
            if not self.left:
                return
            victim = self.left.pop(0)
            victim.kind = "HUNG" if hung else "CRASHED"
            victim.message = f"more than {TIMEOUT} s of computing" if hung else f"exit code {process.returncode}: {lines[-1:]}"

    def watch(self, process):
        """Until the process ends or one scenario takes too long; true when it was killed."""
        last, since, self.computed = None, 0.0, 0.0
        while process.poll() is None:
            self.computed = max(self.computed, computing_time(process.pid))
            with open(self.folder / "errors") as errors:
                lines = errors.read().splitlines()
            before = len(self.left)
            complete = [line for line in lines if line.startswith("ambrig: ")]
            self.collect(complete[:-1])  # the last one may still be written
            if len(self.left) != before or last is None:
                last, since = len(self.left), self.computed
            if self.computed - since > TIMEOUT:
                process.kill()
                process.wait()
                return True
            time.sleep(0.05)
        return False


def computing_time(process):
    """CPU time of a running process [s]."""
    try:
        fields = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def work(options, tables, indices):
    """All of some indices, in as many rounds as their draws need."""
    draws = [Draw(i, tables) for i in indices]
    for _ in range(DRAWS):
        for fidelity in ("switching", "averaged", "reference"):
            open_draws = [d for d in draws if d.kind is None and d.fidelity == fidelity]
            if not open_draws:
                continue
            with tempfile.TemporaryDirectory(prefix="random_scenario_") as name:
                folder = pathlib.Path(name)
                for draw in open_draws:
                    draw.write(folder)
                Batch(options.ambrig, folder, fidelity, open_draws).run()
                for draw in open_draws:
                    if options.keep or (draw.kind or "").isupper():
                        target = pathlib.Path(options.keep or "random_scenarios") / str(draw.index)
                        target.mkdir(parents=True, exist_ok=True)
                        for file in (draw.file, f"r{draw.index}.toml"):
                            shutil.copy(folder / file, target)
    return [d.line() for d in draws]


# --- journal and summary ------------------------------------------------------------------------
def read_journal(path):
    lines = {}
    if path and pathlib.Path(path).exists():
        for text in pathlib.Path(path).read_text().splitlines():
            try:
                line = json.loads(text)
                lines[line["i"]] = line
            except (ValueError, KeyError):
                pass  # cut off when it was stopped
    return lines


def summary(lines):
    """Prints the counts; exit code."""
    classes, reasons, found = collections.Counter(), collections.Counter(), collections.Counter()
    for line in lines:
        classes[line["class"]] += 1
        found.update(line["tags"])
        reasons.update(line["refused"])
    for line in lines:
        if line["class"].isupper() or line["class"] == "never accepted":
            print(f"scenario {line['i']} ({line['fidelity']}): {line['class']}: {line['message']}")
    for kind, count in classes.most_common():
        print(f"{count:8d}  {kind}")
    print("among them:")
    for tag, count in sorted(found.items()):
        print(f"{count:8d}    {tag}")
    print(f"{sum(reasons.values()):8d}  draws refused; most often:")
    for reason, count in reasons.most_common(12):
        print(f"{count:8d}    {reason}")
    seconds = sum(line["s"] for line in lines)
    print(f"{len(lines)} scenarios in {seconds:.0f} s, {1e3 * seconds / max(1, len(lines)):.0f} ms each, computing")
    return 1 if any(kind.isupper() for kind in classes) else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ambrig", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("-n", type=int, default=100, help="scenarios")
    parser.add_argument("-j", "--jobs", type=int, default=2)
    parser.add_argument("--batch", type=int, default=50, help="scenarios of one process")
    parser.add_argument("--first", type=int, default=0, help="index of the first one: its seed")
    parser.add_argument("--only", type=int, help="this scenario alone")
    parser.add_argument("--keep", help="keep every scenario's files in this folder")
    parser.add_argument("--journal", help="a line per finished scenario; what it holds is not run again")
    parser.add_argument("--summary", help="count what this journal holds and run nothing")
    parser.add_argument("--minutes", type=float, default=math.inf, help="begin no batch after that")
    options = parser.parse_args()
    if options.summary:
        return summary(list(read_journal(options.summary).values()))
    tables = random_draws.Tables(options.ambrig)
    indices = [options.only] if options.only is not None else range(options.first, options.first + options.n)
    done = read_journal(options.journal)
    lines = [done[i] for i in indices if i in done]
    missing = [i for i in indices if i not in done]
    batches = [missing[k:k + options.batch] for k in range(0, len(missing), options.batch)]
    end, lock = time.monotonic() + 60 * options.minutes, threading.Lock()

    def one(batch):
        if time.monotonic() > end:
            return
        finished = work(options, tables, batch)
        with lock:
            lines.extend(finished)
            if options.journal:
                with open(options.journal, "a") as journal:
                    journal.writelines(json.dumps(line) + "\n" for line in finished)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(one, batches))
    return summary(lines)


if __name__ == "__main__":
    sys.exit(main())
