"""The test programs with all mutants inside: mutated sources are compiled with the commands of an existing build, and take
the place of their objects in the libraries that the test programs are linked with. The build stays as it is."""
import json
import os
import pathlib
import re
import shlex
import subprocess

from mutation import switches


class Build:
    """Compile, archive and link commands of an existing build (one source at a time or unity)."""

    def __init__(self, folder, scratch, prefix=()):
        self.folder, self.scratch, self.prefix = folder, scratch, list(prefix)
        self.compile = {}  # object (relative to the build) -> command
        self.unit = {}     # source -> (object, unity source or None)
        for entry in json.loads((folder / "compile_commands.json").read_text()):
            command = shlex.split(entry["command"])
            if command[0].endswith("ccache"):
                command = command[1:]
            target, file = command[command.index("-o") + 1], os.path.realpath(entry["file"])
            if "/ambrig_" not in "/" + target.removeprefix("CMakeFiles"):
                continue  # objects of tests
            self.compile[target] = command
            if "/Unity/" in file:
                for source in re.findall(r'#include "(.*)"', pathlib.Path(file).read_text()):
                    self.unit[os.path.realpath(source)] = (target, file)
            else:
                self.unit[file] = (target, None)

    def clang_arguments(self):
        """Options for clang's parser: those of some source of the libraries that change what the text means."""
        command = next(c for c in self.compile.values() if "-std=c++20" in c)
        keep = [a for a in command if a.startswith(("-D", "-I", "-std="))]
        for k, word in enumerate(command):
            if word == "-isystem":
                keep += [word, command[k + 1]]
        return keep

    def with_switches(self, command, file, out):
        """The command of an object, for a mutated file."""
        command = list(command)
        command[-1] = str(file)
        at = command.index("-o")
        command[at + 1] = str(out)
        header = self.scratch / "switches.h"
        header.write_text(switches.HEADER)
        return [*command[:at], "-include", str(header), "-Wno-error", "-Wno-narrowing", "-Werror=vla", *command[at:]]

    def units_of(self, sources):
        """object -> the sources of it that are in `sources`."""
        out = {}
        for source in sources:
            target, _ = self.unit[os.path.realpath(source)]
            out.setdefault(target, []).append(os.path.realpath(source))
        return out

    def compile_unit(self, target, mutated):
        """Compiles one object with the mutated sources (original -> file); returns the compiler's errors, None if none."""
        unity = next(self.unit[s][1] for s in mutated)
        file = next(iter(mutated.values()))
        if unity:
            file = self.scratch / "unity" / target.replace("/", "_").replace(".o", "")
            file.parent.mkdir(exist_ok=True)
            text = pathlib.Path(unity).read_text()
            include = lambda m: f'#include "{mutated.get(os.path.realpath(m[1]), m[1])}"'
            file.write_text(re.sub(r'#include "(.*)"', include, text))
        out = self.scratch / "objects" / target
        out.parent.mkdir(parents=True, exist_ok=True)
        command = self.with_switches(self.compile[target], file, out)
        done = subprocess.run([*self.prefix, *command], cwd=self.folder, capture_output=True, text=True)
        return None if done.returncode == 0 else done.stderr

    def last_command(self, target):
        text = subprocess.run(["ninja", "-t", "commands", target], cwd=self.folder, check=True,
                              capture_output=True, text=True).stdout.strip().split("\n")[-1]
        return [shlex.split(part) for part in text.split(" && ") if part.strip() not in (":", "")]

    def link(self, programs, objects, mutants):
        """Links the test programs with these objects of the scratch folder in the place of the build's."""
        (self.scratch / "switches.cc").write_text(switches.SOURCE)
        switch = self.scratch / "switches.o"
        run = lambda command: subprocess.run([*self.prefix, *command], cwd=self.folder, check=True)
        run(["c++", "-O2", f"-DAMBRIG_MUTANTS={mutants}", "-c", str(self.scratch / "switches.cc"), "-o", str(switch)])
        archives = {}
        for name in sorted({o.split("/")[1].removesuffix(".dir") for o in objects}):
            archive = self.scratch / f"lib{name}.a"
            archive.unlink(missing_ok=True)
            parts = next(c for c in self.last_command(f"lib{name}.a") if os.path.basename(c[0]) == "ar")
            members = [str(self.scratch / "objects" / p) if p in objects else p for p in parts if p.endswith(".o")]
            run(["ar", "qc", str(archive), *members])
            run(["ranlib", str(archive)])
            archives[f"lib{name}.a"] = str(archive)
        for program in programs:
            command = next(c for c in self.last_command(program) if "-o" in c)
            command = [archives.get(word, word) for word in command]
            at = command.index("-o")
            command[at + 1] = str(self.scratch / program)
            run([*command[:at], str(switch), *command[at:]])


def error_lines(stderr, file):
    """Lines of this file that the compiler's errors name."""
    return [int(n) for n in re.findall(re.escape(str(file)) + r":(\d+)", stderr)]
