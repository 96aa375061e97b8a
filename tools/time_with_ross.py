#!/usr/bin/env python3
"""CPU time of a Campbell diagram of 50 speeds, ROSS and ambrig side by side in one run. ROSS is warm: its run_campbell is
run once before. ambrig is a whole process that reads the file and writes JSON, once `analyze --campbell` (51 speeds and damped
critical speeds), once the whole `analyze` (with undamped critical speeds, their map, unbalance, statics, axial and
torsional modes). Ends with 1 when the Campbell diagram alone is not ten times as fast.

    python3 tools/time_with_ross.py ross build/release/ambrig      # a checkout of petrobras/ross at v2.3.0"""
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np


def processor_time(binary, file, *options):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    out = file.with_suffix(".out.json")
    done = subprocess.run([binary, "analyze", str(file), "--speed", "4000", "--json", str(out), "--force", *options], stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 1):
        sys.exit(f"ambrig ended with {done.returncode}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    sys.path.insert(0, os.path.abspath(sys.argv[1]))
    import ross
    import ross.rotor_assembly as examples

    speeds, ratios = np.linspace(0, 630, 50), []
    print("| rotor | elements | ROSS, Campbell [s] | ambrig, Campbell [s] | ratio | ambrig, everything [s] |\n|---|---|---|---|---|---|")
    for name in ("rotor_example", "compressor_example"):
        rotor = getattr(examples, name)()
        rotor.run_campbell(speeds[:2])
        start = time.process_time()
        rotor.run_campbell(speeds)
        theirs = time.process_time() - start
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "rotor.json"
            rotor.save(file)
            ours = processor_time(sys.argv[2], file, "--campbell")
            everything = processor_time(sys.argv[2], file)
        ratios.append(theirs / ours)
        print(f"| {name} | {len(rotor.shaft_elements)} | {theirs:.2f} | {ours:.3f} | {theirs / ours:.0f} | {everything:.3f} |")
    return int(min(ratios) < 10)


if __name__ == "__main__":
    sys.exit(main())
