#!/usr/bin/env python3
"""Installs ambrig into a scratch folder and uses it from outside the project. Run by ctest.

    packaging/check_package.py BUILD_FOLDER

The installed program runs the installed example; an outside CMake project finds the package, compiles the PID in C,
and the installed program runs it and gives the built-in PID's bits; manual pages and completions are there and are read
without a complaint."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import zipfile

PROJECT = """cmake_minimum_required(VERSION 3.25)
project(outside C)
find_package(ambrig 0.1 REQUIRED)
ambrig_add_controller(pid pid.c)
"""


def run(*command, cwd=None):
    done = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def main():
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        prefix, outside = folder / "usr", folder / "outside"
        run("cmake", "--install", sys.argv[1], "--prefix", prefix)
        examples = prefix / "share/doc/ambrig/examples"
        outside.mkdir()
        (outside / "CMakeLists.txt").write_text(PROJECT)
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
        run(program, "export", examples / "reference/rig.toml", "--fmu", "rig.fmu", cwd=outside)
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
        print(f"{len(pages)} manual pages, an outside project's controller gives the same bits")


if __name__ == "__main__":
    main()
