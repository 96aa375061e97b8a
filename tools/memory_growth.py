#!/usr/bin/env python3
"""Does a run of a day fit in memory? Peak memory of a short and a long run of the reference rig with
everything on (noise, detection, a coil fault; no report, which holds at most 4000 points a curve), recorded at 25 Hz, and what it grew by for
each second of the rig beyond the record itself.

  tools/memory_growth.py build/release/ambrig                     9 s and 30 s (ctest)
  tools/memory_growth.py build/release/ambrig --long 600          minutes; sharper

Exit code 1 when 24 h would need more than --limit MB.
"""
import argparse
import os
import pathlib
import sys
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parent.parent
SCENARIO = """name = "long"
rig = "{rig}"
duration = {duration}
record_rate = 25.0
[speed]
profile = [[0.0, 157.08]]
[[fault]]
time = 0.2
target = "A.coil3"
kind = "open"
"""
RECORD_BYTES = 2 * 25 * 64 * 8  # per second: rows, columns, bytes, and once more as the file's image


def peak(ambrig, duration, folder):
    """Peak resident memory [bytes] of a run."""
    scenario = folder / f"{duration:g}.toml"
    scenario.write_text(SCENARIO.format(rig=PROJECT / "scenarios/library/rigs/reference.toml",
                                        duration=float(duration)))
    child = os.fork()
    if child == 0:
        os.chdir(folder)
        os.execv(ambrig, [ambrig, "run", scenario.name, "--quiet", "--out", "out", "--long",
                          "--no-report"])
    _, status, usage = os.wait4(child, 0)
    if status != 0:
        sys.exit(f"memory_growth: the run of {duration} s ended with {status}")
    return usage.ru_maxrss * 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ambrig", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("--short", type=float, default=9, help="s of the rig")
    parser.add_argument("--long", type=float, default=30, help="s of the rig")
    parser.add_argument("--limit", type=float, default=2000, help="MB in 24 h beside the record")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="memory_growth_") as name:
        first = min(peak(options.ambrig, options.short, pathlib.Path(name)) for _ in range(2))
        last = peak(options.ambrig, options.long, pathlib.Path(name))
    seconds = options.long - options.short
    growth = (last - first) / seconds - RECORD_BYTES
    print(f"{options.short:g} s: {first / 1e6:.2f} MB, {options.long:g} s: {last / 1e6:.2f} MB; "
          f"{growth / 1e3:.2f} kB a second of the rig beside the record, "
          f"{growth * 86400 / 1e6:.0f} MB in 24 h")
    return 0 if growth * 86400 / 1e6 <= options.limit else 1


if __name__ == "__main__":
    sys.exit(main())
