#!/usr/bin/env python3
"""Random valid scenarios: rigs drawn over the ranges of the parameter tables, each run once.

Every number of a rig file is drawn: near that of an example rig, or anywhere in the range that
`ambrig parameters` names for it. What `ambrig` refuses is drawn again with fewer numbers far off,
until it is accepted. A run must end by itself, with exit code 0 and with finite numbers only;
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
import tomllib

PROJECT = pathlib.Path(__file__).resolve().parent.parent
RIGS = ["scenarios/library/rigs/reference.toml", "examples/small_spindle/rig.toml",
        "examples/heavy_compressor/rig.toml"]
TIMEOUT = 300  # s of one run
DRAWS = 30  # of one scenario, until one is accepted
MEMORY = 4 << 30  # bytes of one run


# --- the tables ---------------------------------------------------------------------------------
def tables(ambrig):
    """{section: {key: (lo, hi)}} of the numbers of a rig file, and {kind: rows} of the faults."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "parameters.json"
        subprocess.run([ambrig, "parameters", "--json", file], check=True, stdout=subprocess.DEVNULL)
        rows = json.loads(file.read_text())
    numbers, faults = collections.defaultdict(dict), collections.defaultdict(dict)
    for row in rows:
        fault = re.match(r'\[\[fault\]\] kind = "(.*)"', row["section"])
        if fault:
            faults[fault[1]][row["key"].removeprefix("parameters.")] = row["allowed"]
            continue
        lo, hi = re.match(r"(\S+) to (\S+)", row["allowed"]).groups()
        section = row["section"].replace("bearings.M", "bearings.A").replace("bearings.Z", "bearings.A")
        numbers[section][row["key"]] = (float(lo), float(hi))
    return numbers, faults


def ranges_of(numbers, path, table):
    """The ranges that hold for a table of the rig file."""
    if path == "rotor":
        return numbers["[rotor]"]
    if path in ("amplifier", "speed_sensor", "controller"):
        return numbers[f"[{path}]"]
    if re.fullmatch(r"bearings\.\w+", path):
        return numbers[f'[bearings.A] kind = "{table.get("kind", "radial")}"']
    nested = re.fullmatch(r"bearings\.\w+\.(\w+)", path)
    return numbers.get(f"[bearings.A.{nested[1]}]", {}) if nested else {}


# --- drawing ------------------------------------------------------------------------------------
WHOLE = {"turns", "adc_samples_per_period", "adc_bits", "pulses_per_revolution"}


def anywhere(rng, lo, hi):
    """Over decades where the range spans them, from its middle otherwise."""
    hi = min(hi, 1e14)
    if lo >= 0 and hi > 100 * max(lo, 1e-12):
        if lo == 0 and rng.random() < 0.1:
            return 0.0
        low = math.log10(max(lo, hi * 1e-12))
        return min(hi, max(lo, 10 ** rng.uniform(low, math.log10(hi))))
    return rng.uniform(lo, hi)


def drawn(rng, key, value, bounds, far):
    if bounds is None or (isinstance(value, float) and not math.isfinite(value)):
        return value
    lo, hi = bounds
    new = anywhere(rng, lo, hi) if rng.random() < far else value * math.exp(rng.gauss(0, 0.25))
    new = min(hi, max(lo, new))
    if key == "quadrants":
        return rng.choice([2, 4])
    return max(int(math.ceil(lo)), round(new)) if key in WHOLE else float(f"{new:.9g}")


def draw_table(rng, numbers, path, table, far):
    bounds = ranges_of(numbers, path, table)
    out = {}
    for key, value in table.items():
        if isinstance(value, dict) and "value" in value:
            out[key] = drawn(rng, key, float(value["value"]), bounds.get(key), far)
        elif isinstance(value, dict):
            out[key] = draw_table(rng, numbers, f"{path}.{key}" if path else key, value, far)
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            out[key] = drawn(rng, key, value, bounds.get(key), far)
        else:
            out[key] = value
    return out


def limit(table, key, most):
    """Keeps a number below another one that bounds it, so that a wide draw is not refused for that."""
    if isinstance(table.get(key), (int, float)) and table[key] > most:
        table[key] = float(f"{most:.9g}")


def consistent(rig):
    """What ties numbers of a rig to each other: an accepted rig may then be as far off as it was drawn."""
    rotor, amplifier = rig["rotor"], rig["amplifier"]
    if "inertia_polar" in rotor:
        limit(rotor, "inertia_polar", 1.9 * rotor["inertia_transverse"])
    limit(amplifier, "i_max", amplifier.get("adc_range", math.inf))
    limit(rig["controller"], "bias_current", 0.5 * amplifier["i_max"])
    planes = [b["z"] for b in rig["bearings"].values() if b.get("kind", "radial") == "radial"]
    ends = (min(planes) - 0.3 * (max(planes) - min(planes)), max(planes) + 0.3 * (max(planes) - min(planes)))
    for bearing in rig["bearings"].values():
        limit(bearing, "bias_current", 0.5 * amplifier["i_max"])
        if "auxiliary" in bearing:
            limit(bearing["auxiliary"], "clearance", 0.7 * bearing["gap"])
        if "z" in bearing.get("sensor", {}):
            bearing["sensor"]["z"] = float(f"{min(ends[1], max(ends[0], bearing['sensor']['z'])):.9g}")


def draw_rig(rng, numbers, far):
    rig = tomllib.loads((PROJECT / rng.choice(RIGS)).read_text())
    rig.pop("effect", None)
    for name, bearing in list(rig["bearings"].items()):  # each bearing gets numbers of its own
        if "like" in bearing:
            rig["bearings"][name] = dict(rig["bearings"][bearing["like"]], **bearing)
            rig["bearings"][name].pop("like")
    rig = draw_table(rng, numbers, "", rig, far)
    consistent(rig)
    amplifier = rig["amplifier"]
    amplifier["modulation"] = rng.choice(["bi-state", "tri-state", "chopper", "ideal"])
    # The controller is read at an integer fraction of the switching frequency.
    ratio = max(rng.choice([1, 1, 2, 2, 3, 5]), math.ceil(amplifier["switching_frequency"] / 1e6))
    rig["controller"]["rate"] = amplifier["switching_frequency"] / ratio
    rig["gravity"] = [rng.choice([0.0, rng.gauss(0, 5)]), rng.choice([0.0, -9.81, rng.gauss(0, 20)]), 0.0]
    if rng.random() < 0.5:
        rig["detection"] = {"kind": rng.choice(["coupled", "glrt", "current-error", "cusum"])}
    return rig


def fault_value(rng, allowed):
    if allowed == "true, false":
        return True
    lo, hi = (float(x) for x in re.match(r"(?:above )?(\S+) to (?:below )?(\S+)", allowed).groups())
    return max(lo + 1e-6, min(anywhere(rng, lo, min(hi, 1e3)), hi * (1 - 1e-6)))


def draw_fault(rng, rig, faults, duration):
    kind = rng.choice(sorted(faults))
    name = rng.choice(sorted(rig["bearings"]))
    radial = rig["bearings"][name].get("kind", "radial") == "radial"
    target = f"{name}.coil{rng.randint(1, 8 if radial else 2)}"
    if kind == "position-sensor":
        target = f"{name}.{rng.choice('xy')}" if radial else "z"
    fault = {"time": rng.uniform(0, duration), "kind": kind, "parameters": {}}
    if kind != "bus-sag":
        fault["target"] = target
    keys = [k for k in faults[kind] if k]
    if kind == "partial-short":
        keys = ["fraction"] + (["short_resistance"] if rng.random() < 0.5 else [])
    elif kind in ("current-sensor", "position-sensor"):
        keys = [rng.choice(keys)]
    for key in keys:
        fault["parameters"][key] = fault_value(rng, faults[kind][key])
    if not fault["parameters"]:
        fault.pop("parameters")
    return fault


def draw_scenario(rng, rig, faults):
    pwm = rig["amplifier"]["switching_frequency"]
    periods = rng.choice([50, 200, 800])
    duration = periods / pwm
    scenario = {
        "name": "random", "rig": "rig.toml", "duration": duration,
        "record_rate": pwm / rng.choice([1, 2, 5, 10]), "seed": rng.randrange(2**31),
        "noise": rng.random() < 0.8, "fault_tolerance": rng.random() < 0.8,
        "start": {"state": rng.choice(["levitated", "levitated", "resting" if any(rig["gravity"][:2])
                                       else "levitated"])},
        "speed": {"profile": [[0.0, rng.choice([0.0, 10 ** rng.uniform(0, 4)])]]},
    }
    names = sorted(n for n, b in rig["bearings"].items() if b.get("kind", "radial") == "radial")
    if rng.random() < 0.5:
        scenario["load"] = [{"plane": rng.choice(names), "start": rng.uniform(0, duration),
                             "force": [rng.gauss(0, 100), rng.gauss(0, 100)]}]
    if rng.random() < 0.5:
        axis, port = f"{rng.choice(names)}.{rng.choice('xy')}", rng.choice(["force", "reference"])
        scenario["excitation"] = [{
            "target": axis, "port": port, "kind": "sine", "frequency": 10 ** rng.uniform(0, 4),
            "amplitude": rng.gauss(0, 20 if port == "force" else 1e-4)}]
    count = rng.choice([0, 1, 1, 2, 3])
    scenario["fault"] = [draw_fault(rng, rig, faults, duration) for _ in range(count)]
    if not count:
        scenario.pop("fault")
    return scenario


# --- TOML ---------------------------------------------------------------------------------------
def text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return "[" + ", ".join(text(v) for v in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {text(v)}" for k, v in value.items()) + " }"
    return json.dumps(value) if isinstance(value, str) else repr(value)


def toml(document):
    """Numbers and texts first, then a line per table: inline tables may stand anywhere."""
    plain = [f"{k} = {text(v)}" for k, v in document.items() if not isinstance(v, (dict, list)) or
             k in ("gravity",)]
    lines = plain
    for key, value in document.items():
        if isinstance(value, dict) and key == "bearings":
            for name, bearing in value.items():
                lines += [f"[bearings.{name}]"] + [f"{k} = {text(v)}" for k, v in bearing.items()]
        elif isinstance(value, dict):
            lines += [f"[{key}]"] + [f"{k} = {text(v)}" for k, v in value.items()]
        elif isinstance(value, list) and key != "gravity":
            for item in value:
                lines += [f"[[{key}]]"] + [f"{k} = {text(v)}" for k, v in item.items()]
    return "\n".join(lines) + "\n"


# --- one scenario -------------------------------------------------------------------------------
class Draw:
    """A scenario that is drawn until it is accepted; its index is its seed."""

    def __init__(self, index, numbers, faults):
        self.index, self.numbers, self.faults = index, numbers, faults
        self.rng = random.Random(index)
        self.far = self.rng.choice([0.0, 0.05, 0.2, 1.0])
        # The reference engine takes a second for what the switching one does in a twentieth.
        self.fidelity = self.rng.choices(["switching", "averaged", "reference"], [85, 12, 3])[0]
        self.refusals, self.kind, self.message, self.seconds = [], None, "", 0.0

    def write(self, folder):
        rig = draw_rig(self.rng, self.numbers, self.far)
        scenario = draw_scenario(self.rng, rig, self.faults)
        scenario["rig"] = f"r{self.index}.toml"
        (folder / f"r{self.index}.toml").write_text(toml(rig))
        (folder / self.file).write_text(toml(scenario))

    @property
    def file(self):
        return f"s{self.index}.toml"

    def refused(self, message):
        if "could not be integrated" in message or "diverged" in message:
            self.kind = "no solution"
            return
        self.refusals.append(message)
        self.far *= 0.6
        if len(self.refusals) >= DRAWS:
            self.kind, self.message = "never accepted", message

    def line(self):
        reasons = [re.sub(r"-?\d[-+\d.e]*", "#", r.split("toml")[-1])[:70] for r in self.refusals]
        return {"i": self.index, "class": self.kind, "message": self.message, "fidelity": self.fidelity,
                "s": round(self.seconds, 3), "refused": reasons}


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
        self.out = folder / "out"

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
                errors.seek(0)
                lines = errors.read().splitlines()
            self.collect(lines)
            if not self.left:
                return
            victim = self.left.pop(0)
            victim.kind = "HUNG" if hung else "CRASHED"
            victim.message = f"longer than {TIMEOUT} s" if hung else f"exit code {process.returncode}: {lines[-1:]}"

    def watch(self, process):
        """Until the process ends or one scenario takes too long; true when it was killed."""
        last, since = None, time.monotonic()
        while process.poll() is None:
            with open(self.folder / "errors") as errors:
                lines = errors.read().splitlines()
            before = len(self.left)
            complete = [line for line in lines if line.startswith("ambrig: ")]
            self.collect(complete[:-1])  # the last one may still be written
            if len(self.left) != before or last is None:
                last, since = len(self.left), time.monotonic()
            if time.monotonic() - since > TIMEOUT:
                process.kill()
                process.wait()
                return True
            time.sleep(0.05)
        return False


def work(options, numbers, faults, indices):
    """All of some indices, in as many rounds as their draws need."""
    draws = [Draw(i, numbers, faults) for i in indices]
    for _ in range(DRAWS):
        for fidelity in ("switching", "averaged", "reference"):
            open_draws = [d for d in draws if d.kind is None and d.fidelity == fidelity]
            if not open_draws:
                continue
            with tempfile.TemporaryDirectory(prefix="random_scenario_") as name:
                folder = pathlib.Path(name)
                for draw in open_draws:
                    draw.write(folder)
                begun = time.monotonic()
                Batch(options.ambrig, folder, fidelity, open_draws).run()
                for draw in open_draws:
                    draw.seconds += (time.monotonic() - begun) / len(open_draws)
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
    classes, reasons = collections.Counter(), collections.Counter()
    for line in lines:
        classes[line["class"]] += 1
        reasons.update(line["refused"])
    for line in lines:
        if line["class"].isupper() or line["class"] == "never accepted":
            print(f"scenario {line['i']} ({line['fidelity']}): {line['class']}: {line['message']}")
    for kind, count in classes.most_common():
        print(f"{count:8d}  {kind}")
    print(f"{sum(reasons.values()):8d}  draws refused; most often:")
    for reason, count in reasons.most_common(12):
        print(f"{count:8d}    {reason}")
    seconds = sum(line["s"] for line in lines)
    print(f"{len(lines)} scenarios in {seconds:.0f} s, {1e3 * seconds / max(1, len(lines)):.0f} ms each")
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
    numbers, faults = tables(options.ambrig)
    indices = [options.only] if options.only is not None else range(options.first, options.first + options.n)
    done = read_journal(options.journal)
    lines = [done[i] for i in indices if i in done]
    missing = [i for i in indices if i not in done]
    batches = [missing[k:k + options.batch] for k in range(0, len(missing), options.batch)]
    end, lock = time.monotonic() + 60 * options.minutes, threading.Lock()

    def one(batch):
        if time.monotonic() > end:
            return
        finished = work(options, numbers, faults, batch)
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
