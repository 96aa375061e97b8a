#!/usr/bin/env python3
"""Random valid scenarios: rigs drawn over the ranges of the parameter tables, each run once.

Every number of a rig file is drawn: near that of an example rig, or anywhere in the range that
`ambrig parameters` names for it. What `ambrig` refuses is drawn again with fewer numbers far off,
until it is accepted. A run must end by itself, with exit code 0 and with finite numbers only;
its outcome (stayed up, touched down, dropped, beyond the model, no solution) is counted.

  tools/random_scenarios.py build/release/ambrig                     100 scenarios, as CI does
  tools/random_scenarios.py build/release/ambrig -n 100000 -j 2      hours
  tools/random_scenarios.py build/release/ambrig --only 4711 --keep out

Exit code 1 when a run crashed, hung, ended with a program error or left a number that is none;
its files stay in the folder named (default: random_scenarios).
"""
import argparse
import collections
import concurrent.futures
import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib

PROJECT = pathlib.Path(__file__).resolve().parent.parent
RIGS = ["scenarios/library/rigs/reference.toml", "examples/small_spindle/rig.toml",
        "examples/heavy_compressor/rig.toml"]
TIMEOUT = 600  # s of one run: stiff contact in the reference engine takes minutes
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


def draw_rig(rng, numbers, far):
    rig = tomllib.loads((PROJECT / rng.choice(RIGS)).read_text())
    rig.pop("effect", None)
    for name, bearing in list(rig["bearings"].items()):  # each bearing gets numbers of its own
        if "like" in bearing:
            rig["bearings"][name] = dict(rig["bearings"][bearing["like"]], **bearing)
            rig["bearings"][name].pop("like")
    rig = draw_table(rng, numbers, "", rig, far)
    amplifier = rig["amplifier"]
    amplifier["modulation"] = rng.choice(["bi-state", "tri-state", "chopper", "ideal"])
    # The controller is read at an integer fraction of the switching frequency.
    rig["controller"]["rate"] = amplifier["switching_frequency"] / rng.choice([1, 1, 2, 2, 3, 5])
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
        "start": {"state": rng.choice(["levitated", "levitated", "resting"])},
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
def run(ambrig, folder, fidelity):
    """(class, message) of one run."""
    command = ["prlimit", f"--as={MEMORY}", ambrig, "run", "s.toml", "--out", "out", "--no-report",
               "--csv", "--quiet", "--fidelity", fidelity]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=TIMEOUT)
    except subprocess.TimeoutExpired:
        return "HUNG", f"longer than {TIMEOUT} s"
    message = done.stderr.strip()
    if done.returncode == 2:
        if "could not be integrated" in message or "diverged" in message:
            return "no solution", ""
        return ("refused", message) if message.count("\n") == 0 else ("MANY LINES", message)
    if done.returncode != 0:
        return "CRASHED", f"exit code {done.returncode}: {message}"
    return outcome(folder / "out")


def outcome(out):
    result = json.loads((out / "s.json").read_text())
    metrics = {k: v for k, v in result["metrics"].items() if not k.endswith("_delay")}
    numbers = [v for v in metrics.values() if not isinstance(v, dict)]
    numbers += list(metrics["max_orbit"].values())
    if any(v is None or not math.isfinite(v) for v in numbers):
        return "NOT A NUMBER", json.dumps(metrics)
    with open(out / "s.csv") as rows:
        for number, row in enumerate(rows, 1):
            if ",," in row or row.rstrip().endswith(",") or "nan" in row or "inf" in row:
                return "NOT A NUMBER", f"s.csv:{number}"
    if any("model" in note and "invalid" in note for note in result.get("notes", [])):
        return "beyond the model", ""
    return ("dropped" if result["drop"] else
            "touched down" if result["touchdown"] else "stayed up"), ""


def scenario(arguments):
    """Draws until accepted; (index, class, message, refusals)."""
    ambrig, numbers, faults, index, keep = arguments
    rng = random.Random(index)
    far, refusals = rng.choice([0.0, 0.05, 0.2, 1.0]), []
    for _ in range(30):
        with tempfile.TemporaryDirectory(prefix="random_scenario_") as name:
            folder = pathlib.Path(name)
            rig = draw_rig(rng, numbers, far)
            (folder / "rig.toml").write_text(toml(rig))
            (folder / "s.toml").write_text(toml(draw_scenario(rng, rig, faults)))
            fidelity = rng.choice(["switching", "switching", "averaged", "reference"])
            kind, message = run(ambrig, folder, fidelity)
            if keep or kind.isupper():
                shutil.copytree(folder, pathlib.Path(keep or "random_scenarios") / str(index),
                                dirs_exist_ok=True)
        if kind != "refused":
            return index, kind, f"{fidelity}: {message}" if message else "", refusals
        refusals.append(message)
        far *= 0.6
    return index, "never accepted", refusals[-1], refusals


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ambrig", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("-n", type=int, default=100, help="scenarios")
    parser.add_argument("-j", "--jobs", type=int, default=2)
    parser.add_argument("--first", type=int, default=0, help="index of the first one: its seed")
    parser.add_argument("--only", type=int, help="this scenario alone")
    parser.add_argument("--keep", help="keep every scenario's files in this folder")
    parser.add_argument("--json", help="write the counts to this file")
    options = parser.parse_args()
    numbers, faults = tables(options.ambrig)
    indices = [options.only] if options.only is not None else range(options.first,
                                                                    options.first + options.n)
    classes, reasons, bad = collections.Counter(), collections.Counter(), []
    work = ((options.ambrig, numbers, faults, i, options.keep) for i in indices)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for index, kind, message, refusals in pool.map(scenario, work):
            classes[kind] += 1
            for reason in refusals:
                reasons[re.sub(r"-?\d[-+\d.e]*", "#", reason.split("toml")[-1])[:70]] += 1
            if kind.isupper() or kind == "never accepted":
                bad.append((index, kind, message))
                print(f"scenario {index}: {kind}: {message}", flush=True)
    for kind, count in classes.most_common():
        print(f"{count:8d}  {kind}")
    print(f"{sum(reasons.values()):8d}  draws refused; most often:")
    for reason, count in reasons.most_common(12):
        print(f"{count:8d}    {reason}")
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(classes))
    return 1 if any(kind.isupper() for _, kind, _ in bad) else 0


if __name__ == "__main__":
    sys.exit(main())
