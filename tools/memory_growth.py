#!/usr/bin/env python3
"""Does a run of a day fit in memory? Anonymous memory (heap and stacks, without the pages of the program's own
file, whose number depends on the machine) late in a short and a long run of the reference rig with everything on
(noise, detection, a coil fault; no report, which holds at most 4000 points a curve), recorded at 25 Hz, and what
it grew by for each second of the rig beyond the record itself.

  tools/memory_growth.py build/release/ambrig                     9 s and 30 s (ctest)
  tools/memory_growth.py build/release/ambrig --long 600          minutes; sharper

  tools/memory_growth.py build/release/ambrig --day scenarios/limits/day.toml      24 h in one run

`--day` runs a scenario as its file has it and logs the resident memory (--log, a line every ten
seconds: wall time [s], MB). Exit code 1 when 24 h would need more than --limit MB, with --day when the
memory grew by more than the record from the first quarter of the run to its end.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

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
RECORD_BYTES = 25 * 64 * 8  # per second: rows, columns, bytes
LATE = 0.8  # share of the run after which memory is read; its end, when the file is written, is left out


def late_level(ambrig, duration, folder):
    """Median anonymous memory [bytes] over the last part of a run."""
    scenario = folder / f"{duration:g}.toml"
    scenario.write_text(SCENARIO.format(rig=PROJECT / "scenarios/library/rigs/reference.toml",
                                        duration=float(duration)))
    process = subprocess.Popen([ambrig, "run", scenario.name, "--quiet", "--out", "out", "--long",
                                "--no-report"], cwd=folder)
    begun, seen = time.monotonic(), []
    while process.poll() is None:
        memory = resident(process.pid, "RssAnon:")
        if memory:
            seen.append((time.monotonic() - begun, memory))
        time.sleep(0.005)
    if process.returncode != 0:
        sys.exit(f"memory_growth: the run of {duration} s ended with {process.returncode}")
    late = [memory for when, memory in seen if when > LATE * seen[-1][0]]
    return statistics.median(late)


def resident(process, line_name="VmRSS:"):
    """Resident memory of a running process [bytes], None when it has ended. RssAnon: the anonymous part."""
    try:
        for line in pathlib.Path(f"/proc/{process}/status").read_text().splitlines():
            if line.startswith(line_name):
                return int(line.split()[1]) * 1024
    except OSError:
        pass
    return None


def whole_run(ambrig, scenario, log):
    """Runs a scenario and logs its memory; exit code."""
    with tempfile.TemporaryDirectory(prefix="memory_growth_") as out:
        begun, seen = time.monotonic(), []
        process = subprocess.Popen([ambrig, "run", scenario, "--quiet", "--out", out, "--long", "--no-report"])
        while process.poll() is None:
            memory = resident(process.pid)
            if memory:
                seen.append((time.monotonic() - begun, memory / 1e6))
                log.write("%.0f %.2f\n" % seen[-1])
                log.flush()
            time.sleep(10 if seen and seen[-1][0] > 30 else 1)
        if process.returncode != 0:
            sys.exit(f"memory_growth: {scenario} ended with {process.returncode}")
        stem = pathlib.Path(scenario).stem
        result = json.loads((pathlib.Path(out) / f"{stem}.json").read_text())
        record = (pathlib.Path(out) / f"{stem}.h5").stat().st_size / 1e6
    running = [mb for _, mb in seen[:-1]] or [seen[-1][1]]  # the record is written at the end
    quarter = running[len(running) // 4]
    print(f"{scenario}: {seen[-1][0]:.0f} s of computing; resident after a quarter {quarter:.2f} MB, "
          f"at the end {running[-1]:.2f} MB, largest {max(mb for _, mb in seen):.2f} MB; record {record:.2f} MB; "
          f"{'dropped' if result['drop'] else 'stayed up'}, "
          f"false alarms {result['metrics']['false_alarms']:.0f}")
    return 0 if running[-1] - quarter <= max(1.0, record) else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ambrig", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("--short", type=float, default=9, help="s of the rig")
    parser.add_argument("--long", type=float, default=30, help="s of the rig")
    parser.add_argument("--limit", type=float, default=2000, help="MB in 24 h beside the record")
    parser.add_argument("--day", help="run this scenario as it stands, with its memory logged")
    parser.add_argument("--log", type=argparse.FileType("w"), default=sys.stderr, help="of --day")
    options = parser.parse_args()
    if options.day:
        return whole_run(options.ambrig, options.day, options.log)
    with tempfile.TemporaryDirectory(prefix="memory_growth_") as name:
        first = late_level(options.ambrig, options.short, pathlib.Path(name))
        last = late_level(options.ambrig, options.long, pathlib.Path(name))
    seconds = (1 + LATE) / 2 * (options.long - options.short)  # between the middles of the two last parts
    growth = (last - first) / seconds - RECORD_BYTES
    print(f"{options.short:g} s: {first / 1e6:.2f} MB, {options.long:g} s: {last / 1e6:.2f} MB; "
          f"{growth / 1e3:.2f} kB a second of the rig beside the record, "
          f"{growth * 86400 / 1e6:.0f} MB in 24 h")
    return 0 if growth * 86400 / 1e6 <= options.limit else 1


if __name__ == "__main__":
    sys.exit(main())
