#!/usr/bin/env python3
"""Installs ambrig into a scratch folder and uses it from outside the project. Run by ctest.

    packaging/check_package.py BUILD_FOLDER

The installed program runs the installed example; an outside CMake project finds the package, compiles the PID in C,
and the installed program runs it and gives the built-in PID's bits; so does a program in C++ that is linked with the
installed library, and the installed Python module where the build has it; manual pages and completions are there and
are read without a complaint."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import zipfile

PROJECT = """cmake_minimum_required(VERSION 3.25)
project(outside C CXX)
find_package(ambrig 0.1 REQUIRED COMPONENTS library)
ambrig_add_controller(pid pid.c)
add_executable(simulate simulate.cc)
target_link_libraries(simulate PRIVATE ambrig::library)
"""

# What docs/guide/install.md shows.
SIMULATE = """#include <cstdio>

#include "rig/rig_file.h"
#include "simulation/simulate.h"

int main(int, char** file) {
  const ambrig::RigParameters rig = ambrig::ReadRig(file[1]);
  const ambrig::Scenario scenario = ambrig::ReadScenario(file[2], rig);
  const ambrig::RunResult run = ambrig::Simulate(rig, scenario, {});
  for (const double x : run.record.Find("A.x")->samples) std::printf("%.17g\\n", x);
}
"""

MODULE = """import ambrig
for x in ambrig.run("a.toml")["A.x"]: print(repr(float(x)))
"""


def run(*command, cwd=None):
    done = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def column(text, name):
    rows = [line.split(",") for line in text.splitlines()]
    at = [cell.split(" ")[0] for cell in rows[0]].index(name)
    return [float(row[at]) for row in rows[1:]]


def main():
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        prefix, outside = folder / "usr", folder / "outside"
        run("cmake", "--install", sys.argv[1], "--prefix", prefix)
        examples = prefix / "share/doc/ambrig/examples"
        outside.mkdir()
        (outside / "CMakeLists.txt").write_text(PROJECT)
        (outside / "simulate.cc").write_text(SIMULATE)
        shutil.copy(examples / "controllers/pid.c", outside)
        run("cmake", "-S", outside, "-B", outside / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
        run("cmake", "--build", outside / "build")
        rig = (examples / "reference/rig.toml").read_text()
        ours = rig.replace('kind = "pid"\n', 'kind = "library"\nfile = "build/pid.so"\nparameters = { kp = 4.0e5, kd = 900.0, '
                           'ki = 6.0e6, derivative_time_constant = 1.5e-4 }\n', 1)
        head, tail = ours.split("[bearings.A]", 1)
        head = "\n".join(line for line in head.split("\n")
                         if not line.startswith(("kp = 4.0e5", "kd = 900", "ki = 6.0e6", "derivative_time_constant =")))
        (outside / "rig.toml").write_text(rig)
        (outside / "c.toml").write_text(head + "[bearings.A]" + tail)
        for name, of in (("a", "rig.toml"), ("b", "c.toml")):
            (outside / f"{name}.toml").write_text(f'name = "s"\nrig = "{of}"\nduration = 0.02\n')
        program = prefix / "bin/ambrig"
        run(program, "run", "a.toml", "b.toml", "--csv", "--no-report", cwd=outside)
        a, b = ((outside / f"out/{n}.csv").read_text().split("\n", 1)[1] for n in "ab")
        if a != b or len(a) < 10000:
            sys.exit("the PID in C does not give the built-in PID's record")
        wanted = column((outside / "out/a.csv").read_text(), "A.x")
        if [float(x) for x in run("build/simulate", "rig.toml", "a.toml", cwd=outside).split()] != wanted:
            sys.exit("the program in C++ does not give the record of ambrig run")
        module = prefix / "lib/python3/dist-packages"
        if module.exists():
            told = run("env", f"PYTHONPATH={module}", "/usr/bin/python3", "-c", MODULE, cwd=outside)
            if [float(x) for x in told.split()] != wanted:
                sys.exit("the Python module does not give the record of ambrig run")
        # Called by its name, as a shell finds it.
        run("env", f"PATH={prefix / 'bin'}:/usr/bin:/bin", "ambrig", "export", examples / "reference/rig.toml", "--fmu", "rig.fmu",
            cwd=outside)
        with zipfile.ZipFile(outside / "rig.fmu") as fmu:
            if fmu.testzip() or "binaries/linux64/rig.so" not in fmu.namelist():
                sys.exit(f"rig.fmu holds {fmu.namelist()}")
        run("bash", "-n", prefix / "share/bash-completion/completions/ambrig")
        pages = sorted((prefix / "share/man/man1").glob("ambrig*.1"))
        if len(pages) < 20:
            sys.exit(f"only {len(pages)} manual pages")
        if shutil.which("man"):
            shown = subprocess.run(["man", "--warnings", "-l", str(prefix / "share/man/man1/ambrig-run.1")],
                                   capture_output=True, text=True, env={"PATH": "/usr/bin:/bin", "MANPAGER": "cat"})
            if "--keep-going" not in shown.stdout or shown.stderr:
                sys.exit(f"man ambrig-run: {shown.stderr}{shown.stdout[:500]}")
        print(f"{len(pages)} manual pages; an outside project's controller and program"
              f"{' and Python' if module.exists() else ''} give the same bits")


if __name__ == "__main__":
    main()
