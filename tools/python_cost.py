#!/usr/bin/env python3
"""What a run from Python costs beside `ambrig run`: seconds of the processor for the same run and the same record on disk.

    PYTHONPATH=build/release/python /usr/bin/python3 tools/python_cost.py build/release/ambrig [-n 10]

The two take turns; compared are the least times of each, which other work on the machine disturbs least. Not counted is what
a session of Python pays once, its start and `import ambrig`. Fails above 2 %."""
import argparse
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

import ambrig

RIG = pathlib.Path(__file__).resolve().parents[1] / "examples/reference/rig.toml"


def seconds(who):
    used = resource.getrusage(who)
    return used.ru_utime + used.ru_stime


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program")
    options.add_argument("-n", type=int, default=10)
    chosen = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scenario = os.path.join(folder, "s.toml")
        pathlib.Path(scenario).write_text(f'name = "s"\nrig = "{RIG}"\nduration = 2.0\n[speed]\nprofile = [[0.0, 150.0]]\n')
        command, python = [], []
        for _ in range(chosen.n):
            before = seconds(resource.RUSAGE_CHILDREN)
            subprocess.run([chosen.program, "run", scenario, "--no-report", "--quiet", "--out", folder], check=True)
            command.append(seconds(resource.RUSAGE_CHILDREN) - before)
            before = seconds(resource.RUSAGE_SELF)
            ambrig.run(scenario).save(os.path.join(folder, "p.h5"))
            python.append(seconds(resource.RUSAGE_SELF) - before)
        more = 100 * (min(python) / min(command) - 1)
        print(f"ambrig run {min(command):.3f} s, Python {min(python):.3f} s of the processor: {more:+.1f} %")
        sys.exit(more > 2)


if __name__ == "__main__":
    main()
