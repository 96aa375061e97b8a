#!/usr/bin/env python3
"""Every reader against inputs that libFuzzer makes (preset `fuzz`: clang, address and undefined-behaviour sanitizer).

  tools/setup.sh --fuzz && cmake --preset fuzz && cmake --build --preset fuzz
  tools/fuzz_readers.py                           # 10^6 executions of each of the targets in tests/fuzz
  tools/fuzz_readers.py --only csv --runs 20000

Seeds are files of this repository. A finding is a crash, a report of a sanitizer, an exception that is no InputError, a refusal of
more than one line, more than 20 s or 3 GB for one input. It is kept (--keep FOLDER); put it into tests/fuzz/findings/TARGET with
its mend: what lies there is a seed of that target. Exit code 1: there are findings.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
INSTRUMENTS = "tests/core/data/instruments"
SEEDS = {
    "rig": ["scenarios/library/rigs/*.toml", "examples/*/rig.toml", "examples/stators/*/rig.toml", "examples/stators/*.toml"],
    "scenario": ["scenarios/library/*.toml", "examples/*/*.toml"],
    "case": ["examples/mls2em/case.toml"],
    "campaign": ["scenarios/campaigns/*.toml"],
    "detector_study": ["scenarios/campaigns/*.toml"],
    "study": ["examples/design/*.toml"],
    "shaft": ["examples/shaft/*.toml", "examples/tum_mbtr/*.toml"],
    "ross": ["tests/rotor/**/*.json"],
    "csv": [f"{INSTRUMENTS}/*.csv", f"{INSTRUMENTS}/*.txt", "examples/mls2em/data/*.csv"],
    "mat": [f"{INSTRUMENTS}/*.mat"],
    "hdf5": [f"{INSTRUMENTS}/*.h5", "tests/**/*.h5"],
    "universal_file": [f"{INSTRUMENTS}/*.uff", f"{INSTRUMENTS}/*.unv"],
    "labview_text": [f"{INSTRUMENTS}/*.lvm"],
    "tdms": [f"{INSTRUMENTS}/*.tdms"],
}
# Short ones of kinds of which no file is kept.
TEXTS = {
    "formula": ["2 * x + sin(v) / (1 + i^2)", "x > 0 ? x : -x", "abs(min(x, v)) * exp(-i)"],
    "journal": ['{"work":"campaign"}\n{"run":1,"row":"1,up"}\n{"run":2}\n'],
    "campaign_row": ["3,A:5+7,open,157.08,1,0.5,up,1.2e-05,4e-05,,0,0"],
    "fmu_description": ['<?xml version="1.0"?><fmiModelDescription fmiVersion="2.0" guid="{1}"><CoSimulation modelIdentifier="pid"/>'
                        '<ModelVariables><ScalarVariable name="x" valueReference="1" causality="input"><Real/></ScalarVariable>'
                        "</ModelVariables></fmiModelDescription>"],
    "commissioning": ['kind = "commissioning"\nversion = 1\n[bearing.A]\nrate = 25000.0\ngain = [1, 1, 1, 1, 1, 1, 1, 1]\n'],
    "ross": ['{"parameters": {"rotor": {}}, "ShaftElement_0": {"L": 0.25, "idl": 0, "odl": 0.05, "material": "steel", "n": 0},'
             ' "DiskElement_0": {"n": 1, "m": 3.0, "Id": 0.1, "Ip": 0.2}, "BearingElement_0": {"n": 0, "kxx": [1e6], "cxx": [0]}}'],
}
LARGEST = 65536  # of a seed [bytes]
# What the libraries behind a reader do by themselves with damaged files, and what therefore is not reported: matio asks for gigabytes
# that it does not touch (the memory in use stays limited), HDF5 1.10.8 copies attributes over themselves with memcpy.
FLAGS = {"mat": ["-malloc_limit_mb=65536"]}
SANITIZER = {"hdf5": ":replace_intrin=0", "mat": ":replace_intrin=0"}


def make_corpus(target, folder):
    """Copies the seeds of a target into a folder of their own."""
    number = 0
    for pattern in SEEDS.get(target, []) + [f"tests/fuzz/findings/{target}/*"]:
        for file in sorted(ROOT.glob(pattern)):
            if file.is_file() and file.stat().st_size <= LARGEST:
                shutil.copy(file, folder / f"seed-{number}")
                number += 1
    for text in TEXTS.get(target, []):
        (folder / f"text-{number}").write_text(text)
        number += 1
    return number


def fuzz(target, options):
    """Runs one target. @return (target, executions, seeds, finding or None)"""
    program = options.build / f"{target}_fuzzer"
    with tempfile.TemporaryDirectory() as scratch:
        corpus = pathlib.Path(scratch) / "corpus"
        corpus.mkdir()
        seeds = make_corpus(target, corpus)
        options.keep.mkdir(parents=True, exist_ok=True)
        done = subprocess.run(
            [program, f"-runs={options.runs}", f"-seed={options.seed}", "-max_len=16384", "-timeout=20", "-rss_limit_mb=3072",
             "-print_final_stats=1", *FLAGS.get(target, []), f"-max_total_time={options.seconds}", f"-artifact_prefix={options.keep}/{target}-", corpus],
            cwd=scratch, env=os.environ | {"ASAN_OPTIONS": "allocator_may_return_null=1" + SANITIZER.get(target, "")}, text=True, errors="replace", stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
    count = re.findall(r"number_of_executed_units: (\d+)", done.stderr) or re.findall(r"^#(\d+)", done.stderr, re.MULTILINE) or ["0"]
    finding = None
    if done.returncode != 0:
        lines = [l for l in done.stderr.splitlines() if re.search(r"ERROR:|runtime error|Sanitizer|ALARM|what\(\)", l)]
        where = [l.strip() for l in done.stderr.splitlines() if re.match(r"\s+#\d+ .* in ambrig::", l)]
        finding = (lines or ["exit code %d" % done.returncode])[0] + (f" ({where[0]})" if where else "")
        (options.keep / f"{target}.log").write_text(done.stderr)
    return target, int(count[-1]), seeds, finding


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/fuzz")
    parser.add_argument("--runs", type=int, default=1_000_000, help="executions of each target")
    parser.add_argument("--seconds", type=int, default=0, help="at most so long for each target (0: no limit)")
    parser.add_argument("--only", action="append", help="only this target; may be given several times")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, default=ROOT / "build/fuzz/findings")
    options = parser.parse_args()
    options.keep = options.keep.resolve()
    targets = sorted(p.name.removesuffix("_fuzzer.cc") for p in (ROOT / "tests/fuzz").glob("*_fuzzer.cc"))
    wrong = [t for t in options.only or [] if t not in targets]
    if wrong:
        sys.exit(f"fuzz_readers: no target {wrong[0]} (allowed: {', '.join(targets)})")
    missing = [t for t in options.only or targets if not (options.build / f"{t}_fuzzer").exists()]
    if missing:
        sys.exit(f"fuzz_readers: {options.build}/{missing[0]}_fuzzer is not built: cmake --preset fuzz && cmake --build --preset fuzz")
    failed = False
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for target, count, seeds, finding in pool.map(lambda t: fuzz(t, options), options.only or targets):
            print(f"{target:16} {count:9} executions, {seeds:3} seeds: {finding or 'no finding'}", flush=True)
            failed |= finding is not None
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
