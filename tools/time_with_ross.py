#!/usr/bin/env python3
"""CPU time of a Campbell diagram of 50 speeds, ROSS and ambrig side by side in one run. ROSS is warm: its run_campbell is
run once before. ambrig is its whole `analyze`: reading the file, modes at 51 and more speeds, critical speeds, their map,
unbalance, statics, axial and torsional modes and writing JSON.

    python3 tools/time_with_ross.py ross build/release/ambrig      # a checkout of petrobras/ross at v2.3.0"""
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np


def main():
    sys.path.insert(0, os.path.abspath(sys.argv[1]))
    import ross
    import ross.rotor_assembly as examples

    speeds, ratios = np.linspace(0, 630, 50), []
    print("| rotor | elements | ROSS [s] | ambrig [s] | ratio |\n|---|---|---|---|---|")
    for name in ("rotor_example", "compressor_example"):
        rotor = getattr(examples, name)()
        rotor.run_campbell(speeds[:2])
        start = time.process_time()
        rotor.run_campbell(speeds)
        theirs = time.process_time() - start
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "rotor.json"
            rotor.save(file)
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            done = subprocess.run([sys.argv[2], "analyze", str(file), "--speed", "4000", "--json", str(file.with_suffix(".out.json"))], stdout=subprocess.DEVNULL)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            if done.returncode not in (0, 1):
                sys.exit(f"ambrig ended with {done.returncode}")
        ours = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        ratios.append(theirs / ours)
        print(f"| {name} | {len(rotor.shaft_elements)} | {theirs:.2f} | {ours:.3f} | {theirs / ours:.0f} |")
    return int(min(ratios) < 10)


if __name__ == "__main__":
    sys.exit(main())
