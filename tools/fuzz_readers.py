#!/usr/bin/env python3
"""Every reader against inputs that libFuzzer makes (preset `fuzz`: clang, address and undefined-behaviour sanitizer).

  tools/setup.sh --fuzz && cmake --preset fuzz && cmake --build --preset fuzz
  tools/fuzz_readers.py                           # 10^6 executions of each of the targets in tests/fuzz
  tools/fuzz_readers.py --only csv --runs 20000
  tools/fuzz_readers.py --corpus /tmp/corpus      # keeps the inputs that reached something new; the next call begins with them

Seeds are files of this repository, and what lies in tests/fuzz/seeds/TARGET and tests/fuzz/findings/TARGET; their words are
libFuzzer's dictionary. A finding is a crash, a report of a sanitizer, an exception that is no InputError, a refusal of more than
one line, more than 10 s (--timeout) or 1 GB for one input. It is kept (--keep FOLDER); put it into tests/fuzz/findings/TARGET with its mend.
Exit code 1: there are findings.
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
    "case": ["examples/*/case.toml"],
    "campaign": ["scenarios/campaigns/*.toml"],
    "detector_study": ["scenarios/studies/*.toml"],
    "study": ["examples/design/*.toml"],
    "commissioning": ["examples/*/*.commissioning.toml"],
    "shaft": ["examples/shaft/*.toml", "examples/tum_mbtr/*.toml", "tests/rotor/ross_files/*.toml"],
    "ross": ["tests/rotor/**/*.json"],
    "csv": [f"{INSTRUMENTS}/*.csv", f"{INSTRUMENTS}/*.txt", "examples/*/data/*.csv"],
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
    "campaign_row": ["0,s,A:1,1,exact,open,simultaneous,0.001,157.08,0,0,51.9,2.8,0,0,1135186513210162,,,,,up,1,1,1,0.00012,0.00012,0,1500,"
                     "4e-06,4e-06,4e-06,0.0002,0,4.4,40.4,0,0,yes,,,,"],
    "fmu_description": ['<?xml version="1.0"?><fmiModelDescription fmiVersion="2.0" guid="{1}"><CoSimulation modelIdentifier="pid"/>'
                        '<ModelVariables><ScalarVariable name="x" valueReference="1" causality="input"><Real/></ScalarVariable>'
                        "</ModelVariables></fmiModelDescription>"],
    "ross": ['{"parameters": {"rotor": {}}, "ShaftElement_0": {"L": 0.25, "idl": 0, "odl": 0.05, "n": 0,'
             ' "material": {"E": 2.11e11, "rho": 7810, "Poisson": 0.3}},'
             ' "DiskElement_0": {"n": 1, "m": 3.0, "Id": 0.1, "Ip": 0.2}, "BearingElement_0": {"n": 0, "kxx": [1e6], "cxx": [0]}}'],
}
LARGEST = 65536  # of a seed [bytes]
LENGTHS = (4096, 16384)  # of an input: the longest seed, within these [bytes]; what only repeats itself costs time
NUMBERS = ["nan", "-inf", "1e308", "-1", "0.0", "4294967296", "9223372036854775807"]
WORDS = 600      # of a dictionary
# What the libraries behind a reader do by themselves with damaged files, and what therefore is not reported: matio asks for gigabytes
# that it does not touch, of which the sanitizer's own notes fill an eighth: it gets none of them; HDF5 1.10.8 copies attributes over
# themselves with memcpy. It also reads beyond its own memory while it decodes damaged attributes (H5Aopen): that is reported.
FLAGS = {"mat": ["-malloc_limit_mb=65536", "-detect_leaks=0"], "hdf5": ["-detect_leaks=0"]}  # HDF5 leaves 112 bytes behind
# Every exception makes the sanitizer sweep the copies of the stack that it keeps for uses after return: an eighth of the time of readers
# that mostly refuse. The tests of the preset `asan` (g++) do not look for these uses either.
ALWAYS = "allocator_may_return_null=1:quarantine_size_mb=64:detect_stack_use_after_return=0"
SANITIZER = {"hdf5": ":replace_intrin=0", "mat": ":replace_intrin=0:max_allocation_size_mb=256"}


def with_whole_paths(text, file):
    """Where a TOML file names files beside it, their whole paths: the target reads its input elsewhere."""
    beside = lambda m: (file.parent / m[1]).resolve()
    return re.sub(r'"([\w./-]+\.\w+)"', lambda m: f'"{beside(m)}"' if beside(m).is_file() else m[0], text)


def make_corpus(target, folder, dictionary):
    """Copies the seeds of a target into a folder of their own, and the words of those that are text into a dictionary.

    @return how many seeds, and the most bytes of an input"""
    seeds = [text.encode() for text in TEXTS.get(target, [])]
    for pattern in SEEDS.get(target, []) + [f"tests/fuzz/{kind}/{target}/*" for kind in ("seeds", "findings")]:
        for file in sorted(ROOT.glob(pattern)):
            if file.is_file() and file.stat().st_size <= LARGEST:
                seeds.append(with_whole_paths(file.read_text(), file).encode() if file.suffix == ".toml" else file.read_bytes())
    for number, seed in enumerate(seeds):
        (folder / f"seed-{number}").write_bytes(seed)
    words = {word.decode() for seed in seeds if 0 not in seed for word in re.findall(rb"[A-Za-z_][A-Za-z0-9_.-]{1,30}", seed)}
    dictionary.write_text("".join(f'"{word}"\n' for word in [*NUMBERS, *sorted(words)[:WORDS]]))
    return len(seeds), min(max(LENGTHS[0], *map(len, seeds)), LENGTHS[1])


def fuzz(target, options):
    """Runs one target. @return (target, executions, seeds, finding or None)"""
    program = options.build / f"{target}_fuzzer"
    with tempfile.TemporaryDirectory() as scratch:
        corpus, dictionary = (options.corpus or pathlib.Path(scratch)).resolve() / target, pathlib.Path(scratch) / "words"
        corpus.mkdir(parents=True, exist_ok=True)
        seeds, longest = make_corpus(target, corpus, dictionary)
        options.keep.mkdir(parents=True, exist_ok=True)
        done = subprocess.run(
            [program, f"-runs={options.runs}", f"-dict={dictionary}", f"-seed={options.seed}", f"-max_len={longest}",
             f"-timeout={options.timeout}", f"-report_slow_units={options.timeout}", "-rss_limit_mb=1024", "-print_final_stats=1", *FLAGS.get(target, []), f"-max_total_time={options.seconds}", f"-artifact_prefix={scratch}/{target}-", corpus],
            cwd=scratch, env=os.environ | {"ASAN_OPTIONS": ALWAYS + SANITIZER.get(target, "")}, text=True, errors="replace", stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
        if done.returncode != 0:
            (options.keep / f"{target}.log").write_text(done.stderr)
            # The copies in which HDF5 is tried leave theirs too; the last is that of the process itself.
            made = sorted(pathlib.Path(scratch).glob(f"{target}-*"), key=lambda p: p.stat().st_mtime_ns)
            for file in made[-1:]:
                shutil.copy(file, options.keep)
    count = re.findall(r"number_of_executed_units: (\d+)", done.stderr) or re.findall(r"^#(\d+)", done.stderr, re.MULTILINE) or ["0"]
    finding = None
    if done.returncode != 0:
        lines = [l for l in done.stderr.splitlines() if re.search(r"ERROR:|runtime error|Sanitizer|ALARM|what\(\)", l)]
        where = [l.strip() for l in done.stderr.splitlines() if re.match(r"\s+#\d+ .* in ambrig::", l)]
        finding = (lines or ["exit code %d" % done.returncode])[0] + (f" ({where[0]})" if where else "")
    return target, int(count[-1]), seeds, finding


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/fuzz")
    parser.add_argument("--runs", type=int, default=1_000_000, help="executions of each target")
    parser.add_argument("--seconds", type=int, default=0, help="at most so long for each target (0: no limit)")
    parser.add_argument("--timeout", type=int, default=10, help="[s] for one input; more on a machine that others keep busy")
    parser.add_argument("--only", action="append", help="only this target; may be given several times")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--corpus", type=pathlib.Path, help="folder of inputs that later calls go on with")
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
