#!/usr/bin/env python3
"""Damaged input against a built `ambrig`: files of every kind are mutated at random and given to the command that reads them.

  tools/fuzz.py build/asan/ambrig --runs 2000 --seed 1        # best with the preset asan
  tools/fuzz.py build/asan/ambrig --only run-rig --runs 300

A run may end with 0 or 1 and whole, finite JSON, or with 2, one line and no file written. All else is a finding: a signal, a
report of a sanitizer, exit 3 (program error), more than one line, NaN in a result, a file half-written, no end in time. Findings
are kept (--keep FOLDER, one folder each with the command and its words). The same seed makes the same files.
"""
import argparse
import json
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
RIG = (ROOT / "scenarios/library/rigs/reference.toml").read_bytes()
BEAM = ROOT / "examples/tum_mbtr"
SCENARIO = b"""name = "t"
rig = "rig.toml"
duration = 0.003
record_rate = 12500.0
seed = 3
drop_limit = 0.01
[start]
state = "clamped"
position = { A = [1e-5, 0.0] }
[speed]
profile = [[0.0, 100.0], [0.002, 200.0]]
free_from = 0.0025
[[excitation]]
target = "A.x"
kind = "chirp"
amplitude = 1.0
f0 = 10.0
f1 = 100.0
stop = 0.002
[[excitation]]
target = "B.y"
port = "reference"
kind = "multisine"
amplitude = 1e-6
frequencies = [10.0, 20.0]
phases = [0.0, 1.0]
[[load]]
plane = "A"
force = [1.0, 0.0]
start = 0.001
[[fault]]
time = 0.001
target = "A.coil3"
kind = "partial-short"
parameters = { fraction = 0.5, short_resistance = 0.1 }
[[fault]]
time = 0.002
target = "B.coil1"
kind = "current-sensor"
parameters = { gain = 0.9, offset = 0.1 }
[expect]
touchdown = false
max_orbit = 1e-4
"""
EFFECTS = b"""
[[effect]]
name = "eddy-currents"
target = "A"
parameters = { cutoff = 500.0 }
[[effect]]
name = "saturation"
target = "A"
[[effect]]
name = "formula"
target = "A"
formula = { fx = "-k*x - c*vx" }
parameters = { k = 100.0, c = 1.0 }
"""
CAMPAIGN = b"""name = "t"
rig = "rig.toml"
scenarios = ["s.toml"]
seeds = [1]
[faults]
bearings = ["A"]
sets = [[1], [2, 3]]
onset = ["simultaneous"]
time = 0.001
[[faults.kind]]
kind = "open"
[operation]
speeds = [157.08]
"""
PLAIN = b'name = "t"\nrig = "rig.toml"\nduration = 0.003\nrecord_rate = 12500.0\n'



def Cases(binary, work):
    """name -> (files, names that are mutated, command)"""
    record = work / "record"
    record.mkdir()
    (record / "rig.toml").write_bytes(RIG)
    (record / "s.toml").write_bytes(PLAIN)
    subprocess.run([binary, "run", "s.toml", "--quiet", "--no-report", "--csv"], cwd=record, check=True)
    subprocess.run([binary, "rotor", "convert", str(BEAM / "shaft.toml"), "r.json"], cwd=record, stdout=subprocess.DEVNULL)
    h5, csv = (record / "out/s.h5").read_bytes(), (record / "out/s.csv").read_bytes()
    case = b'rig = "rig.toml"\nnoise = { "A.x" = 2e-7, "B.y" = 2e-7 }\n[[record]]\nscenario = "s.toml"\ndata = "%s"\nuse = "%s"\n'
    both = lambda f: case % (f, b"fit") + (case % (f, b"validate")).split(b"\n", 2)[2]
    run = "run s.toml --quiet --no-report --json j.json"
    beam = {p.name: p.read_bytes() for p in BEAM.glob("*.toml")}
    published = ROOT / "examples/validation"
    out = {
        "run-rig": ({"rig.toml": RIG + EFFECTS, "s.toml": SCENARIO}, ["rig.toml"], run),
        "run-scenario": ({"rig.toml": RIG, "s.toml": SCENARIO}, ["s.toml"], run),
        "run-averaged": ({"rig.toml": RIG, "s.toml": SCENARIO}, ["rig.toml", "s.toml"], run + " --fidelity averaged"),
        "check": ({"rig.toml": RIG, "s.toml": SCENARIO}, ["s.toml"], "check s.toml --jobs 1 --json j.json"),
        "crosscheck": ({"rig.toml": RIG, "s.toml": SCENARIO}, ["rig.toml", "s.toml"], "crosscheck s.toml --json j.json"),
        "redistribute": ({"rig.toml": RIG}, ["rig.toml"], "redistribute rig.toml --bearing A --failed 3 --json j.json"),
        "analyze": ({"rig.toml": RIG}, ["rig.toml"], "analyze rig.toml --speed 3000 --json j.json"),
        "analyze-beam": (beam, ["rig.toml", "shaft.toml"], "analyze rig.toml --speed 3000 --json j.json"),
        "campaign": ({"rig.toml": RIG, "s.toml": PLAIN, "c.toml": CAMPAIGN}, ["c.toml"],
                     "campaign c.toml -o o --jobs 1 --no-report --json j.json"),
        "compare-case": ({"rig.toml": RIG, "s.toml": PLAIN, "r.h5": h5, "case.toml": both(b"r.h5")}, ["case.toml"],
                         "compare case.toml --json j.json"),
        "compare-hdf5": ({"rig.toml": RIG, "s.toml": PLAIN, "r.h5": h5, "case.toml": both(b"r.h5")}, ["r.h5"],
                         "compare case.toml --json j.json"),
        "compare-csv": ({"rig.toml": RIG, "s.toml": PLAIN, "r.csv": csv, "case.toml": both(b"r.csv")}, ["r.csv"],
                        "compare case.toml --json j.json"),
        "validate": ({p.name: p.read_bytes() for p in published.glob("mbc500*")}, None, "validate . --json j.json"),
        "convert-shaft": ({"a.toml": beam["shaft.toml"]}, ["a.toml"], "rotor convert a.toml b.json"),
    }
    instruments = {p.name: p.read_bytes() for p in sorted((ROOT / "tests/core/data/instruments").glob("*.*"))
                   if p.suffix not in (".py", ".md")}
    for name, data in instruments.items():
        kind = "instrument-" + name.rsplit(".", 1)[0].replace("_", "-")
        out[kind] = ({name: data}, [name], f"channels {name} --json j.json")
    out["compare-tdms"] = ({"rig.toml": RIG, "s.toml": PLAIN, "case.toml": both(b"tdms_little.tdms"),
                            "tdms_little.tdms": instruments["tdms_little.tdms"]}, ["tdms_little.tdms"],
                           "compare case.toml --json j.json")
    if (record / "r.json").exists():
        out["convert-ross"] = ({"r.json": (record / "r.json").read_bytes()}, ["r.json"], "rotor convert r.json b.toml")
    return out


VALUES = [b"nan", b"inf", b"-inf", b"0", b"0.0", b"-1", b"-1.0", b"1e308", b"-1e308", b"1e-308", b"1e9", b"1e-12", b"9223372036854775807",
          b'""', b'"x"', b"[]", b"{}", b"[[]]", b"true", b"1979-05-27", b"[1.0, 2.0]", b'{ value = 1.0, sd = 1.0 }', b'"A"', b"\xff"]


def MutateText(r, text):
    kind = r.randrange(9)
    if kind <= 3:  # a number or a string becomes something else
        found = list(re.finditer(rb'(?<![\w.])-?\d[\d.]*(?:e-?\d+)?|"[^"\n]*"', text))
        if found:
            m = r.choice(found)
            return text[:m.start()] + r.choice(VALUES) + text[m.end():]
    lines = text.split(b"\n")
    k, j = r.randrange(len(lines)), r.randrange(len(lines))
    if kind == 4:
        del lines[k]
    elif kind == 5:
        lines.insert(j, lines[k])
    elif kind == 6:
        lines[k], lines[j] = lines[j], lines[k]
    elif kind == 7:  # another value by factors that keep it plausible
        found = list(re.finditer(rb"(?<![\w.])\d+\.\d+(?:e-?\d+)?", text))
        if found:
            m = r.choice(found)
            return text[:m.start()] + b"%.6g" % (float(m[0]) * r.choice([-1, 0.01, 0.1, 0.5, 2, 10, 100])) + text[m.end():]
    else:
        return MutateBytes(r, text)
    return b"\n".join(lines)


def MutateBytes(r, data):
    data = bytearray(data)
    kind, at = r.randrange(7), r.randrange(max(1, len(data)))
    if kind == 0:
        return bytes(data[:at])
    if kind == 1 and data:
        data[at] ^= 1 << r.randrange(8)
    elif kind == 2 and data:
        for _ in range(r.randrange(1, 30)):
            data[r.randrange(len(data))] = r.randrange(256)
    elif kind == 3:
        del data[at:at + r.randrange(1, 200)]
    elif kind == 4:
        data[at:at] = bytes(r.randrange(256) for _ in range(r.randrange(1, 20)))
    elif kind == 5:
        data[at:at] = data[at:at + r.randrange(1, 500)]
    else:  # the head of a binary file is where its structure is
        for _ in range(r.randrange(1, 6)):
            if data:
                data[r.randrange(min(len(data), 4096))] = r.choice([0, 0xff, 0x7f, 0x80, 1])
    return bytes(data)


def NoConstant(word):
    raise ValueError(word + " in JSON")


def Verdict(done, folder, before):
    words = done.stderr.decode(errors="replace")
    left = sorted(str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file() and str(p.relative_to(folder)) not in before)
    if "Sanitizer" in words or "runtime error" in words:
        return "sanitizer"
    if done.returncode in (0, 1):
        if any(name.endswith(".tmp") for name in left):
            return "temporary file left"
        try:
            if "j.json" in left:
                json.loads((folder / "j.json").read_text(), parse_constant=NoConstant)
        except ValueError as e:
            return f"bad JSON: {e}"
        return None
    if done.returncode != 2:
        return f"exit {done.returncode}"
    if words.count("\n") != 1 or not words.startswith("ambrig: "):
        return f"{words.count(chr(10))} lines"
    return f"left {left[0]}" if left else None


def Main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("binary")
    p.add_argument("--runs", type=int, default=1000)
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--only", help="kinds of cases that begin so")
    p.add_argument("--timeout", type=float, default=60, help="[s] of one run")
    p.add_argument("--memory", type=float, help="[MB] of address space of one run; not for sanitizers, which reserve terabytes")
    p.add_argument("--keep", default="out/fuzz", help="folder of findings")
    o = p.parse_args()
    binary = str(pathlib.Path(o.binary).resolve())
    keep = pathlib.Path(o.keep)
    counts, findings = {}, 0
    with tempfile.TemporaryDirectory(prefix="ambrig_fuzz_") as temporary:
        work = pathlib.Path(temporary)
        cases = Cases(binary, work)
        names = [n for n in cases if n.startswith(o.only or "")]
        if not names:
            p.error(f"--only {o.only}: allowed: the beginning of one of {', '.join(cases)}")
        limit = int((o.memory or 0) * 1e6)
        bounded = (lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit))) if limit else None
        for n in range(o.runs):
            r = random.Random(f"{o.seed} {n}")
            name = names[n % len(names)]
            files, victims, command = cases[name]
            files = dict(files)
            for _ in range(r.choice([1, 1, 1, 2, 4])):
                victim = r.choice(victims or list(files))
                mutate = MutateText if victim.endswith((".toml", ".csv", ".json", ".lvm", ".unv")) else MutateBytes
                files[victim] = mutate(r, files[victim])
            folder = work / "now"
            folder.mkdir()
            for file, text in files.items():
                (folder / file).write_bytes(text)
            try:
                done = subprocess.run([binary, *command.split()], cwd=folder, capture_output=True, timeout=o.timeout, preexec_fn=bounded)
                verdict, words = Verdict(done, folder, files), done.stderr.decode(errors="replace")
                counts[done.returncode] = counts.get(done.returncode, 0) + 1
            except subprocess.TimeoutExpired:
                verdict, words = f"no end in {o.timeout:g} s", ""
            if verdict:
                findings += 1
                kept = keep / f"{name}-{o.seed}-{n}"
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(folder, kept)
                (kept / "finding.txt").write_text(f"{verdict}\nambrig {command}\n{words}")
                print(f"{kept}: {verdict}: {words.strip().splitlines()[0] if words.strip() else ''}", flush=True)
            shutil.rmtree(folder)
    print(f"{o.runs} runs, {findings} findings; exit codes: " + ", ".join(f"{k}: {v}" for k, v in sorted(counts.items())))
    return findings > 0


if __name__ == "__main__":
    sys.exit(Main())
