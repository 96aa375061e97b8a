"""The tests of a program, which mutants each of them reaches, and what becomes of them with one."""
import json
import os
import pathlib
import resource
import signal
import subprocess
import tempfile
import time

QUICK = 0.3          # [s]
MEMORY = 12 << 30    # [byte] that a mutant may take


def limited(cpu):
    def apply():
        resource.setrlimit(resource.RLIMIT_CPU, (cpu, cpu + 5))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        os.setpgrp()
    return apply


class Suite:
    def __init__(self, root, program, table):
        """`table`: file that keeps what is known of the tests from one call to the next."""
        self.root, self.program, self.table = root, program, table
        self.tests = json.loads(table.read_text()) if table.exists() else {}

    def names(self):
        """name -> source file of every test of the program."""
        listing = self.table.with_suffix(".list.json")
        subprocess.run([str(self.program), "--gtest_list_tests", f"--gtest_output=json:{listing}"], cwd=self.root,
                       check=True, stdout=subprocess.DEVNULL)
        out = {}
        for suite in json.loads(listing.read_text())["testsuites"]:
            for test in suite["testsuite"]:
                if not test["name"].startswith("DISABLED_"):
                    out[f"{suite['name']}.{test['name']}"] = self.room_of(test["file"])
        return out

    def room_of(self, file):
        return os.path.relpath(os.path.join(self.program.parent, file), self.root)

    def start(self, tests, mutant, cpu, wall, reached=None):
        """Runs the tests; (exit code, seconds of CPU, what it said)."""
        environment = {**os.environ, "AMBRIG_MUTANT": str(mutant)}
        if reached:
            environment["AMBRIG_REACHED"] = str(reached)
        command = [str(self.program), "--gtest_brief=1", "--gtest_fail_fast", "--gtest_filter=" + ":".join(tests)]
        with tempfile.TemporaryFile() as said:
            process = subprocess.Popen(command, cwd=self.root, env=environment, stdout=said, stderr=subprocess.STDOUT,
                                       preexec_fn=limited(cpu))
            end, pid = time.monotonic() + wall, 0
            while pid == 0:
                if time.monotonic() > end:
                    os.killpg(process.pid, signal.SIGKILL)
                    pid, status, usage = os.wait4(process.pid, 0)
                else:
                    time.sleep(0.01)
                    pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            process.returncode = os.waitstatus_to_exitcode(status)
            said.seek(0)
            return process.returncode, usage.ru_utime + usage.ru_stime, said.read().decode(errors="replace")

    def measure(self, tell, pool):
        """One healthy run of every test that is new or whose source changed: each in a process of its own, so that
        what one test computes once for all is not missing from the next one's list."""
        names = self.names()
        self.tests = {name: t for name, t in self.tests.items() if name in names}
        changed = lambda file: os.path.getmtime(self.root / file)
        new = [(name, file) for name, file in names.items()
               if name not in self.tests or self.tests[name]["changed"] != changed(file)]
        for (name, file), (seconds, numbers) in zip(new, pool.map(lambda n: self.reach(n[0], tell), new)):
            self.tests[name] = {"file": file, "seconds": round(seconds, 3), "reached": numbers, "changed": changed(file)}
            tell(f"{name} {seconds:.2f} s, {len(numbers)} mutants")
            draft = self.table.with_suffix(".tmp")
            draft.write_text(json.dumps(self.tests, indent=0))
            draft.replace(self.table)

    def reach(self, name, tell):
        """(seconds of CPU, numbers of the mutants that the healthy test comes by)."""
        for attempt in range(2):
            with tempfile.TemporaryDirectory() as folder:
                reached = pathlib.Path(folder) / "reached"
                code, seconds, said = self.start([name], 0, 3600, 3600, reached)
                if code == 0:
                    return seconds, sorted({int(n) for n in reached.read_text().split()}) if reached.exists() else []
            tell(f"{name} fails without a mutant:\n{said[-2000:]}")
        raise SystemExit(f"{self.program.name}: {name} fails without a mutant, twice")

    def phases(self, mutant):
        """Lists of the tests that reach the mutant: quick ones of its own room, other quick ones, slow ones of the room,
        the rest; slow ones one by one, the cheapest first."""
        room = "tests/" + pathlib.PurePath(mutant.name).parent.as_posix() + "/"
        parts = [[], [], [], []]
        for name, t in self.tests.items():
            if mutant.number in t["reached"]:
                parts[(0 if t["file"].startswith(room) else 1) + (0 if t["seconds"] < QUICK else 2)].append(name)
        cost = lambda name: self.tests[name]["seconds"]
        slow = [[name] for part in parts[2:] for name in sorted(part, key=cost)]
        return [p for p in parts[:2] if p] + slow

    def cost(self, mutant):
        """Seconds of all tests that reach it."""
        return sum(t["seconds"] for t in self.tests.values() if mutant.number in t["reached"])

    def judge(self, mutant, patience):
        """(killed or survived, by what, seconds)."""
        begin = time.monotonic()
        spent = lambda: round(time.monotonic() - begin, 1)
        for tests in self.phases(mutant):
            healthy = sum(self.tests[name]["seconds"] for name in tests)
            cpu = int(10 + patience * healthy)
            code, _, said = self.start(tests, mutant.number, cpu, 60 + 6 * cpu)
            if code != 0:
                failed = [line.split("]")[1].split(",")[0].split("(")[0].strip()
                          for line in said.splitlines() if line.startswith("[  FAILED  ]")]
                by = failed[0] if failed else f"{tests[0]} (signal {-code})" if code < 0 else f"exit code {code}"
                return "killed", by, spent()
        return "survived", f"{len(sum(self.phases(mutant), []))} tests reach it", spent()
