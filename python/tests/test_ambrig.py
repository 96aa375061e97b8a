"""The module as a user has it: files, edits, runs, arrays, errors, interruption."""
import gc
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import ambrig

ROOT = pathlib.Path(__file__).resolve().parents[2]
RIG = ROOT / "examples/reference/rig.toml"
SCENARIO = ROOT / "examples/reference/coil_opens.toml"
SHORT = f'name = "short"\nrig = "{RIG}"\nduration = 0.004\nnoise = true\nseed = 3\n'


class Folder(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = pathlib.Path(self._folder.name)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return str(self.folder / name)


class Documents(Folder):
    def test_reads_and_edits_by_the_names_of_the_file(self):
        rig = ambrig.load(RIG)
        self.assertIsInstance(rig, ambrig.Rig)
        self.assertEqual(rig.axes, ["A.x", "A.y", "B.x", "B.y", "z"])
        self.assertEqual(rig["rotor.mass"], 4.2)  # written { value, sd }
        self.assertEqual(rig["bearings.B.turns"], rig["bearings.A.turns"])  # like = "A"
        rig["rotor.mass"] = 4.5
        rig["controller.kp"] = np.float64(5e5)
        rig["gravity"] = [0.0, 0.0, -9.81]
        self.assertEqual((rig["rotor.mass"], rig["controller.kp"], rig["gravity"][2]), (4.5, 5e5, -9.81))
        self.assertIn("sd = 0.01", rig.text)  # the tolerance of the mass stayed
        self.assertIn("# kg m2 about the centre of mass", rig.text)
        self.assertNotIn("rotor.lenght", rig)
        self.assertEqual(ambrig.load(RIG)["rotor.mass"], 4.2)  # the file is as it was
        rig.save(self.folder / "mine.toml")
        self.assertEqual(ambrig.load(self.folder / "mine.toml")["rotor.mass"], 4.5)

    def test_a_value_that_is_not_allowed_changes_nothing(self):
        rig = ambrig.load(RIG)
        before = rig.text
        with self.assertRaises(ambrig.InputError) as caught:
            rig["bearings.A.gap"] = -4e-4
        self.assertIn("gap = -0.0004 m, allowed 1e-06 to 0.1 m", str(caught.exception))
        self.assertEqual(caught.exception.file, str(RIG))
        line = before.splitlines()[caught.exception.line - 1]
        self.assertTrue(line.startswith("gap ="), line)
        self.assertEqual(rig.text, before)
        with self.assertRaises(ambrig.InputError):
            rig["rotor.lenght"] = 1.0
        with self.assertRaises(KeyError):
            rig["rotor.lenght"]

    def test_copies_are_independent(self):
        rig = ambrig.load(RIG)
        other = rig.copy()
        other["rotor.mass"] = 5.0
        self.assertEqual(rig["rotor.mass"], 4.2)

    def test_files_that_are_none(self):
        for name, text in (("missing.toml", None), ("broken.toml", "a = ["), ("binary.toml", b"\xff\xfe\x00")):
            if text is not None:
                (self.folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
            with self.assertRaises(ambrig.InputError):
                ambrig.load(self.folder / name)
        self.assertIsInstance(ambrig.InputError("x"), ValueError)
        with self.assertRaises(ambrig.InputError):
            ambrig.load_rig(SCENARIO)


class Runs(Folder):
    def test_the_numbers_of_the_command(self):
        scenario = self.write("short.toml", SHORT)
        run = ambrig.run(scenario)
        subprocess.run([os.environ["AMBRIG_BINARY"], "run", scenario, "--no-report", "--quiet", "--out", self.folder],
                       check=True)
        written = ambrig.read(self.folder / "short.h5")
        self.assertEqual(list(run), list(written))
        self.assertGreater(len(run), 20)
        for name in run:
            np.testing.assert_array_equal(run[name].view(np.uint64), written[name].view(np.uint64), err_msg=name)
        self.assertEqual(run.units, written.units)
        run.save(self.folder / "mine.h5")
        np.testing.assert_array_equal(ambrig.read(self.folder / "mine.h5")["A.x"], run["A.x"])

    def test_arrays_outlive_the_run(self):
        run = ambrig.run(self.write("short.toml", SHORT))
        x, copy, time_ = run["A.x"], run["A.x"].copy(), run.time
        self.assertTrue(x.flags.writeable and x.dtype == np.float64 and x.shape == time_.shape)
        del run
        gc.collect()
        for _ in range(5):
            ambrig.run(self.write("short.toml", SHORT))
        np.testing.assert_array_equal(x, copy)

    def test_edits_act(self):
        scenario = ambrig.load(self.write("short.toml", SHORT))
        first = ambrig.run(scenario)
        scenario["duration"] = 0.008
        self.assertEqual(len(ambrig.run(scenario).time), 2 * len(first.time))
        scenario["duration"] = 0.004
        np.testing.assert_array_equal(ambrig.run(scenario)["A.x"], first["A.x"])
        scenario.rig["controller.kp"] = 5e5
        self.assertFalse(np.array_equal(ambrig.run(scenario)["A.x"], first["A.x"]))

    def test_a_fault_is_an_event(self):
        run = ambrig.run(SCENARIO)
        self.assertTrue(any(e["kind"] == "fault" or "A.coil" in str(e) for e in run.events), run.events)
        self.assertFalse(run.verdict["drop"])

    def test_xarray_and_orbit(self):
        import matplotlib
        matplotlib.use("agg")
        run = ambrig.run(self.write("short.toml", SHORT))
        data = run.to_xarray()
        self.assertEqual(data["A.x"].attrs["units"], "m")
        self.assertEqual(data["time"].attrs["units"], "s")
        np.testing.assert_array_equal(data["A.i1"].values, run["A.i1"])
        ax = run.plot_orbit("A", start=0.002)
        x, y = ax.lines[0].get_data()
        inside = run.time >= 0.002
        np.testing.assert_allclose(x, run["A.x"][inside] * 1e6)
        np.testing.assert_allclose(y, run["A.y"][inside] * 1e6)
        with self.assertRaisesRegex(KeyError, "allowed: A, B"):
            run.plot_orbit("C")

    def test_wrong_options(self):
        with self.assertRaises(ambrig.InputError):
            ambrig.run(self.write("short.toml", SHORT), fidelity="exact")

    def test_many_runs_need_no_more_memory(self):
        def resident():
            with open("/proc/self/statm") as f:
                return int(f.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        scenario = ambrig.load(self.write("s.toml", SHORT.replace("0.004", "0.001")))
        runs = 10000 if os.environ.get("AMBRIG_SLOW_TESTS") else 400
        for _ in range(runs // 4):
            ambrig.run(scenario)
        before = resident()
        for _ in range(runs):
            ambrig.run(scenario)
        # One leaked record of a run would be some 100 kB.
        self.assertLess(resident() - before, 4e6 + 1e3 * runs / 10)


class Interruption(Folder):
    LONG = SHORT.replace("0.004", "500.0").replace("seed", "record_rate = 100.0\nseed")

    def interrupted(self, work):
        begun = threading.Event()
        def press():
            begun.wait(60)
            time.sleep(0.3)
            press.at = time.monotonic()
            os.kill(os.getpid(), signal.SIGINT)
        thread = threading.Thread(target=press, daemon=True)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            work(lambda fraction: begun.set())
        took = time.monotonic() - press.at
        thread.join()
        self.assertLess(took, 1.0)

    def test_a_run(self):
        scenario = self.write("long.toml", self.LONG)
        self.interrupted(lambda told: ambrig.run(scenario, progress=told))

    def test_a_campaign(self):
        self.write("long.toml", self.LONG)
        campaign = self.write("c.toml", 'rig = "%s"\nduration = 0.3\nseeds = 200\n' % RIG)
        self.interrupted(lambda told: ambrig.campaign(campaign, output=self.folder / "out", jobs=1, progress=told))
        self.assertFalse((self.folder / "out/report.html").exists())
        self.assertLess(len((self.folder / "out/table.csv").read_text().splitlines()), 201)

    def test_an_exception_of_the_progress_ends_the_run(self):
        def no(fraction):
            raise RuntimeError("enough")
        with self.assertRaisesRegex(RuntimeError, "enough"):
            ambrig.run(self.write("long.toml", self.LONG), progress=no)

    def test_other_threads_go_on(self):
        counted = 0
        over = threading.Event()
        def count():
            nonlocal counted
            while not over.is_set():
                counted += 1
                time.sleep(0.001)
        thread = threading.Thread(target=count)
        thread.start()
        begin = time.monotonic()
        ambrig.run(self.write("s.toml", SHORT.replace("0.004", "4.0")))
        took = time.monotonic() - begin
        over.set()
        thread.join()
        self.assertGreater(counted, 100 * took)

    def test_two_at_once_give_the_same_bits(self):
        scenario = self.write("s.toml", SHORT.replace("0.004", "0.1"))
        alone = ambrig.run(scenario)
        found = []
        threads = [threading.Thread(target=lambda: found.append(ambrig.run(scenario))) for _ in range(3)]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        self.assertEqual(len(found), 3)
        for run in found:
            np.testing.assert_array_equal(run["B.y"], alone["B.y"])


class Commands(Folder):
    def test_analyze_a_rig_that_was_edited(self):
        rig = ambrig.load(RIG)
        told = []
        plain = ambrig.analyze(rig, progress=told.append)
        self.assertTrue(plain.text)
        rig["controller.kd"] = 100.0
        self.assertNotEqual(ambrig.analyze(rig), plain)
        self.assertEqual(told[-1], 1.0)

    def test_redistribute(self):
        answer = ambrig.redistribute(RIG, bearing="A", failed="1")
        self.assertEqual(answer["sets"][0]["failed"], [1])
        self.assertEqual(np.shape(answer["sets"][0]["W"]), (8, 3))

    def test_campaign(self):
        file = self.write("c.toml", 'rig = "%s"\nduration = 0.004\nseeds = 3\n' % RIG)
        told = []
        ambrig.campaign(file, output=self.folder / "out", no_report=True, progress=told.append)
        self.assertEqual(len((self.folder / "out/table.csv").read_text().splitlines()), 4)
        self.assertEqual(told[-1], 1.0)

    def test_compare(self):
        scenario = self.write("s.toml", SHORT.replace("0.004", "0.05"))
        ambrig.run(scenario).save(self.folder / "s.h5")
        ambrig.run(self.write("o.toml", SHORT.replace("0.004", "0.05").replace("= 3", "= 4"))).save(self.folder / "o.h5")
        case = self.write("case.toml", f'rig = "{RIG}"\n[[record]]\nscenario = "s.toml"\ndata = "s.h5"\n'
                                       '[[record]]\nscenario = "o.toml"\ndata = "o.h5"\nuse = "validate"\n')
        self.assertTrue(ambrig.compare(case))

    def test_mistakes(self):
        with self.assertRaisesRegex(ambrig.InputError, "ambrig analyze: .*nonsense"):
            ambrig.analyze(RIG, nonsense=3)
        with self.assertRaisesRegex(ambrig.InputError, "no such file|cannot"):
            ambrig.compare(self.folder / "none.toml")

    def test_what_python_prints_stays(self):
        out = subprocess.run([sys.executable, "-c", "import ambrig; print('a'); t = ambrig.call('effects').text; "
                                                    "print('b', len(t) > 100)"], capture_output=True, text=True)
        self.assertEqual(out.stdout, "a\nb True\n", out.stderr)


class Types(unittest.TestCase):
    def test_mypy(self):
        try:
            import mypy.api
        except ImportError:
            self.skipTest("mypy is not installed")
        text, errors, code = mypy.api.run(["--strict", "--config-file", str(ROOT / "pyproject.toml"),
                                           "--cache-dir", tempfile.mkdtemp(), str(ROOT / "python/ambrig")])
        self.assertEqual(code, 0, text + errors)


if __name__ == "__main__":
    unittest.main()
