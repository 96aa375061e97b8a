"""What tools/random_draws.py draws from: the ranges and kinds that the program names, and how far off an example."""
import collections
import json
import math
import pathlib
import re
import subprocess
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parent.parent
RIGS = {  # and how often each is taken
    "scenarios/library/rigs/reference.toml": 4, "examples/small_spindle/rig.toml": 4,
    "examples/heavy_compressor/rig.toml": 2, "scenarios/limits/one_axis.toml": 2, "examples/mls2em/rig.toml": 1,
    "examples/stators/e_core_and_thrust.toml": 2, "examples/stators/heteropolar.toml": 2,
    "examples/stators/homopolar.toml": 2, "examples/stators/series_pairs.toml": 2,
    "examples/stators/six_poles.toml": 2, "examples/tum_mbtr/rig.toml": 1,
}


class Tables:
    """Ranges of rig files, faults and effects as the program names them; the parts of the example rigs."""

    def __init__(self, ambrig):
        self.numbers, self.faults = collections.defaultdict(dict), collections.defaultdict(dict)
        with tempfile.TemporaryDirectory() as folder:
            def answer(*command):
                file = pathlib.Path(folder) / "answer.json"
                subprocess.run([ambrig, *command, "--json", file], check=True, stdout=subprocess.DEVNULL)
                return json.loads(file.read_text())

            for row in answer("parameters"):
                self.add_row(row)
            self.effects = [e for e in answer("effects") if e["parameters"]]
            self.rigs = {name: Parts(answer("rig", PROJECT / name)) for name in RIGS}
        reference = (PROJECT / "scenarios/library/rigs/reference.toml").read_text()
        self.modulations = allowed(ambrig, reference.replace('"bi-state"', '"?"'))
        self.detectors = allowed(ambrig, reference.replace("[detection]\n", '[detection]\nkind = "?"\n'))

    def add_row(self, row):
        fault = re.match(r'\[\[fault\]\] kind = "(.*)"', row["section"])
        if fault:
            self.faults[fault[1]][row["key"].removeprefix("parameters.")] = row["allowed"]
            return
        bounds = re.match(r"(\S+) to (\S+)", row["allowed"])
        if not bounds:  # a key of words, lists or tables: drawn by what follows, or as in the example
            return
        lo, hi = bounds.groups()
        section = row["section"].replace("bearings.M", "bearings.A").replace("bearings.Z", "bearings.A")
        self.numbers[section][row["key"]] = (float(lo), float(hi))

    def ranges_of(self, path, table):
        """The ranges that hold for a table of the rig file."""
        if path in ("rotor", "amplifier", "speed_sensor", "controller"):
            return self.numbers[f"[{path}]"]
        if re.fullmatch(r"bearings\.\w+", path):
            kind = table.get("kind", "radial")
            if "stator" in kind:
                return {**self.numbers['[bearings.A] kind = "stator" or "axial-stator"'],
                        **self.numbers['[bearings.A] template = "..."']}
            return self.numbers[f'[bearings.A] kind = "{kind}"']
        nested = re.fullmatch(r"bearings\.\w+\.(\w+)", path)
        return self.numbers.get(f"[bearings.A.{nested[1]}]", {}) if nested else {}


def allowed(ambrig, rig):
    """The choices that `ambrig run` names for the "?" of a rig file."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "rig.toml").write_text(rig)
        (pathlib.Path(folder) / "run.toml").write_text(
            'name = "ask"\nrig = "rig.toml"\nduration = 1.0e-3\nrecord_rate = 25000.0\n')
        said = subprocess.run([ambrig, "run", "run.toml"], cwd=folder, capture_output=True, text=True).stderr
    return re.search(r"allowed: ([-\w, ]+)$", said.strip())[1].split(", ")


class Parts:
    """Coils and axes of a rig."""

    def __init__(self, answer):
        self.bearings = answer["bearings"]
        self.coils = [c["name"] for b in self.bearings for c in b["coils"]]
        self.axes = [a for b in self.bearings for a in b["axes"]]
        self.radial = [b["name"] for b in self.bearings if b["axes"] != ["z"]]
        self.stators = [b["name"] for b in self.bearings if "stator" in b["kind"]]
        self.planes = [b["name"] for b in self.bearings if len(b["axes"]) == 2]
        self.names = [b["name"] for b in self.bearings]


class Far:
    """How far off the example a rig is: share of numbers from anywhere, spread of the logarithm of the others."""

    def __init__(self, share, spread):
        self.share, self.spread = share, spread

    def nearer(self):
        return Far(0.6 * self.share, 0.8 * self.spread)


def draw_far(rng):
    """Two rigs of three work as a rule, near their example; the others are from far to anything at all."""
    return rng.choices([Far(0, 0.03), Far(0, 0.1), Far(0.03, 0.1), Far(0.2, 0.25), Far(1.0, 0.25)],
                       [35, 25, 15, 15, 10])[0]


# --- numbers ------------------------------------------------------------------------------------
WHOLE = {"turns", "adc_samples_per_period", "adc_bits", "pulses_per_revolution", "coils"}
KEPT = {"poles", "plane", "side", "coils", "cone_deg", "angle_deg"}  # what makes the stator what it is


def anywhere(rng, lo, hi):
    """Over decades where the range spans them, from its middle otherwise."""
    lo, hi = max(lo, -1e14), min(hi, 1e14)
    if lo >= 0 and hi > 100 * max(lo, 1e-12):
        if lo == 0 and rng.random() < 0.1:
            return 0.0
        low = math.log10(max(lo, hi * 1e-12))
        return min(hi, max(lo, 10 ** rng.uniform(low, math.log10(hi))))
    return rng.uniform(lo, hi)


def number(value):
    return float(f"{value:.9g}")


def drawn(rng, key, value, bounds, far):
    if bounds is None or key in KEPT or not math.isfinite(value):
        return value
    lo, hi = bounds
    new = anywhere(rng, lo, hi) if rng.random() < far.share else value * math.exp(rng.gauss(0, far.spread))
    new = min(hi, max(lo, new))
    if key == "quadrants":
        return rng.choice([2, 4]) if rng.random() < 0.3 else value
    return max(int(math.ceil(lo)), round(new)) if key in WHOLE else number(new)
