"""The draws of tools/random_scenarios.py: a rig file and a scenario file from a random generator.

Every number is drawn near that of an example rig or anywhere in the range that `ambrig parameters`
and `ambrig effects` name for it; kinds (bearings, modulations, modes, detectors, controllers, starts,
faults, excitations, effects) are drawn among all that there are.

A draw is cheap on purpose: `within_cost` bounds what it computes (samples of all coils, and pieces
of a period in contact) for 97 of 100 draws. The others are as dear as they come, up to a bound that
one process still ends within seconds.
"""
import collections
import json
import math
import pathlib
import re
import subprocess
import tempfile
import tomllib

PROJECT = pathlib.Path(__file__).resolve().parent.parent
RIGS = {  # and how often each is taken
    "scenarios/library/rigs/reference.toml": 4, "examples/small_spindle/rig.toml": 4,
    "examples/heavy_compressor/rig.toml": 2, "scenarios/limits/one_axis.toml": 2, "examples/mls2em/rig.toml": 1,
    "examples/stators/e_core_and_thrust.toml": 2, "examples/stators/heteropolar.toml": 2,
    "examples/stators/homopolar.toml": 2, "examples/stators/series_pairs.toml": 2,
    "examples/stators/six_poles.toml": 2, "examples/tum_mbtr/rig.toml": 1,
}
WARM_UP = {"levitated": 0.25, "clamped": 0.03, "resting": 0.0}  # s before t = 0 (simulation/sampled/start_state.h)
CHEAP, DEAR = 1e6, 3e7  # samples of a coil, warm-up included: some 5 and 150 ms


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
        self.detectors = allowed(ambrig, reference + '\n[detection]\nkind = "?"\n')

    def add_row(self, row):
        fault = re.match(r'\[\[fault\]\] kind = "(.*)"', row["section"])
        if fault:
            self.faults[fault[1]][row["key"].removeprefix("parameters.")] = row["allowed"]
            return
        lo, hi = re.match(r"(\S+) to (\S+)", row["allowed"]).groups()
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


def draw_table(rng, tables, path, table, far):
    bounds = tables.ranges_of(path, table)
    out = {}
    for key, value in table.items():
        below = f"{path}.{key}" if path else key
        if isinstance(value, dict) and "value" in value:
            out[key] = drawn(rng, key, float(value["value"]), bounds.get(key), far)
        elif isinstance(value, dict):
            out[key] = draw_table(rng, tables, below, value, far)
        elif key == "poles" and isinstance(value, list):
            scale = {k: math.exp(rng.gauss(0, far.spread)) for k in ("area", "gap")}  # one for all: they balance
            out[key] = [dict(pole, **{k: number(f * pole[k]) for k, f in scale.items()}) for pole in value]
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            out[key] = drawn(rng, key, value, bounds.get(key), far)
        else:
            out[key] = value
    return out


def limit(table, key, most):
    """Keeps a number below another one that bounds it, so that a wide draw is not refused for that."""
    if isinstance(table.get(key), (int, float)) and table[key] > most:
        table[key] = number(most)


def consistent(rig):
    """What ties numbers of a rig to each other: an accepted rig may then be as far off as it was drawn."""
    rotor, amplifier = rig["rotor"], rig["amplifier"]
    if "inertia_polar" in rotor:
        limit(rotor, "inertia_polar", 1.9 * rotor["inertia_transverse"])
    limit(amplifier, "i_max", amplifier.get("adc_range", math.inf))
    limit(rig["controller"], "bias_current", 0.5 * amplifier["i_max"])
    planes = [b["z"] for b in rig["bearings"].values() if "z" in b]
    reach = 0.3 * (max(planes) - min(planes)) if planes else 0
    for bearing in rig["bearings"].values():
        limit(bearing, "bias_current", 0.5 * amplifier["i_max"])
        gap = bearing.get("gap") or min((p["gap"] for p in bearing.get("poles", []) if isinstance(p, dict)),
                                        default=math.inf)
        if "auxiliary" in bearing:
            limit(bearing["auxiliary"], "clearance", 0.7 * gap)
        if "z" in bearing.get("sensor", {}):
            z = min(max(planes) + reach, max(min(planes) - reach, bearing["sensor"]["z"]))
            if "file" in rotor:
                z = min(0.7, max(0.0, z))  # on the example's shaft
            bearing["sensor"]["z"] = number(z)


# --- rig ----------------------------------------------------------------------------------------
def example(rng):
    name = rng.choices(list(RIGS), RIGS.values())[0]
    rig = tomllib.loads((PROJECT / name).read_text())
    rig.pop("effect", None)
    if "file" in rig["rotor"]:
        rig["rotor"]["file"] = str((PROJECT / name).parent / rig["rotor"]["file"])
    for bearing, table in list(rig["bearings"].items()):  # each bearing gets numbers of its own
        if "like" in table:
            rig["bearings"][bearing] = dict(rig["bearings"][table["like"]], **table)
            rig["bearings"][bearing].pop("like")
    return name, rig


def draw_amplifier(rng, tables, amplifier, far):
    bi_state = amplifier["modulation"] in ("bi-state", "two-level")
    if rng.random() < (0.4 if bi_state else 0.7):  # the detectors watch bi-state bridges only
        amplifier["modulation"] = rng.choice(tables.modulations)
    elif rng.random() < 0.5:
        amplifier["modulation"] = rng.choice(["bi-state", "two-level"])
    if rng.random() < 0.07:
        amplifier["mode"] = "voltage"
        amplifier.pop("bandwidth", None)
        amplifier.pop("ki", None)
        amplifier["kp"] = number(anywhere(rng, 0.1, 100))
    elif "bandwidth" in amplifier and rng.random() < far.share:
        amplifier.pop("bandwidth")
        amplifier["kp"], amplifier["ki"] = number(anywhere(rng, 0.1, 100)), number(anywhere(rng, 10, 1e5))
    elif rng.random() < 0.1 or "bandwidth" in amplifier:
        amplifier.pop("kp", None)
        amplifier.pop("ki", None)
        most = amplifier["switching_frequency"] / 12
        amplifier["bandwidth"] = number(min(most, amplifier.get("bandwidth", anywhere(rng, 1, most))))
    if rng.random() < 0.2:
        amplifier["delay"] = number(rng.uniform(0, 3) / amplifier["switching_frequency"])
    if rng.random() < 0.2 and amplifier["modulation"] not in ("linear",):
        amplifier["duty_limits"] = [number(rng.uniform(0, 0.3)), number(rng.uniform(0.5, 1))]


def draw_controller(rng, tables, rig, parts, far):
    controller = rig["controller"]
    if rng.random() < 0.1:
        controller["filter"] = [draw_filter(rng, tables) for _ in range(rng.choice([1, 1, 2]))]
    if rng.random() < 0.05:
        controller["schedule"] = [{"speed": s, "kp": controller["kp"] * rng.uniform(0.5, 2)} for s in (0.0, 500.0)]
    if rng.random() < 0.05:
        controller["unbalance"] = {"from_speed": number(anywhere(rng, 1, 1e4)), "bandwidth":
                                   number(anywhere(rng, 0.01, 100)), "phase_deg": number(rng.uniform(-180, 180))}
    if len(parts.radial) == 2 and rng.random() < 0.06 and "filter" not in controller and "schedule" not in controller:
        gains = {k: controller.pop(k) for k in ("kp", "kd", "ki", "derivative_time_constant")}
        if rng.random() < 0.5:
            arm = 0.01
            controller.update(kind="tilt-translation", translation={k: 2 * v if k != "derivative_time_constant" else v
                                                                    for k, v in gains.items()},
                              tilt={k: v * arm if k != "derivative_time_constant" else v for k, v in gains.items()})
        else:
            controller.update(kind="lqg", position_weight=1e-5, integral_weight=2e-7,
                              force_weight=number(anywhere(rng, 1, 1e3)), force_noise=1.0, sensor_noise=2e-7)


def draw_filter(rng, tables):
    kind = rng.choice(["notch", "lead-lag", "low-pass"])
    table = tables.numbers[f'[[controller.filter]] kind = "{kind}"']
    return {"kind": kind, **{k: number(anywhere(rng, max(lo, 1e-3), min(hi, 1e4))) for k, (lo, hi) in table.items()}}


def acts(effect, parts):
    """Whether the effect has a place on a rig: laws of the magnets know eight poles and opposed ones."""
    if effect["target"] == "bearing":
        return not parts.stators
    return effect["target"] not in ("plane", "plane or z") or bool(parts.radial)


def draw_effect(rng, tables, parts):
    """An effect of the catalogue: sizes as usual, now and then anywhere in what is possible."""
    effect = rng.choice([e for e in tables.effects if acts(e, parts)])
    target, wide = rng.choice([t for t in effect["target"].split(" or ") if t != "z" or "z" in parts.axes]), \
        rng.random() < 0.2
    out = {"name": effect["name"], "parameters": {}}
    for row in rng.sample(effect["parameters"], min(len(effect["parameters"]), rng.choice([1, 1, 2, 3]))):
        lo, hi = row["typical"]
        if wide:
            lo, hi = (float(row[k]) for k in ("min", "max"))
        out["parameters"][row["name"]] = number(anywhere(rng, lo, hi))
    if target != "rig":
        out["target"] = rng.choice({"coil": parts.coils, "axis": parts.axes, "z": ["z"]}.get(
            target, parts.names if target == "bearing" else parts.radial))
    return out


def draw_rig(rng, tables, far):
    """(table of the rig file, its parts)"""
    name, rig = example(rng)
    parts = tables.rigs[name]
    gravity = rig.get("gravity", [0, 0, 0])
    rig = draw_table(rng, tables, "", {k: v for k, v in rig.items() if k != "gravity"}, far)
    consistent(rig)
    if rng.random() < 0.5:
        gravity = [g * math.exp(rng.gauss(0, 0.25)) for g in gravity]
    elif len(parts.axes) > 1:
        gravity = [rng.choice([0.0, rng.gauss(0, 5)]), rng.choice([0.0, -9.81, rng.gauss(0, 20)]),
                   rng.choice([0.0, rng.gauss(0, 5)]) if "z" in parts.axes else 0.0]
    rig["gravity"] = gravity
    draw_amplifier(rng, tables, rig["amplifier"], far)
    draw_controller(rng, tables, rig, parts, far)
    if rng.random() < 0.2:
        rig["speed_sensor"] = {k: number(anywhere(rng, lo, hi)) if k not in WHOLE else rng.choice([0, 1, 8, 60, 5000])
                               for k, (lo, hi) in tables.numbers["[speed_sensor]"].items() if rng.random() < 0.5}
    if rng.random() < 0.5:
        rig["detection"] = {"kind": rng.choice(tables.detectors)}
    effects = [draw_effect(rng, tables, parts) for _ in range(rng.choice([0, 0, 1, 1, 2]))]
    if effects:
        rig["effect"] = effects
    return rig, parts


# --- cost ---------------------------------------------------------------------------------------
def within_cost(rng, rig, parts, state, far):
    """Lowers the switching frequency and the stiffness of contacts until a run is cheap (docstring)."""
    amplifier, rotor = rig["amplifier"], rig["rotor"]
    dear = rng.random() < 0.02
    most = DEAR if dear else CHEAP
    if far.share > 0.1 and state != "clamped":
        most *= 0.2  # a rotor that is lost in its bearings takes up to 400 pieces a period
    per_period = amplifier.get("adc_samples_per_period", 18) * (4 + len(parts.coils))
    periods = most / per_period
    if WARM_UP[state]:
        top = max(10.0, periods / WARM_UP[state])
        if amplifier["switching_frequency"] > top:
            amplifier["switching_frequency"] = number(top * 10 ** rng.uniform(-0.5, 0))
    pwm = amplifier["switching_frequency"]
    # The controller is read at an integer fraction of the switching frequency.
    ratio = max(rng.choice([1, 1, 2, 2, 3, 5]), math.ceil(pwm / 1e6))
    rig["controller"]["rate"] = pwm / ratio
    if "bandwidth" in amplifier:
        limit(amplifier, "bandwidth", pwm / 12)
    # In contact a period is cut into pieces of 0.02 / rate; 400 at most.
    pieces = max(8.0, most / 200 / max(1.0, WARM_UP[state] * pwm))
    for bearing in rig["bearings"].values():
        if "auxiliary" not in bearing:
            continue
        if not dear and rng.random() < 0.95:
            bearing["auxiliary"]["friction"] = 0.0  # a rotor pressed deep into it slides in 400 pieces a period
        mobility = 1 / rotor.get("mass", 1.0) + bearing.get("z", 0.0) ** 2 / rotor.get("inertia_transverse", math.inf)
        limit(bearing["auxiliary"], "stiffness", max(1.0, (pieces * 0.02 * pwm) ** 2 / mobility))
    return min(periods, 4000)


# --- scenario -----------------------------------------------------------------------------------
def fault_value(rng, allowed):
    if allowed == "true, false":
        return True
    lo, hi = (float(x) for x in re.match(r"(?:above )?(\S+) to (?:below )?(\S+)", allowed).groups())
    return max(lo + 1e-6, min(anywhere(rng, lo, min(hi, 1e3)), hi * (1 - 1e-6)))


def draw_fault(rng, parts, faults, duration):
    kind = rng.choice(sorted(faults))
    fault = {"time": rng.uniform(0, duration), "kind": kind, "parameters": {}}
    if kind != "bus-sag":
        fault["target"] = rng.choice(parts.axes if kind == "position-sensor" else parts.coils)
    keys = [k for k in faults[kind] if k]
    if kind == "partial-short":
        keys = ["fraction"] + (["short_resistance"] if rng.random() < 0.5 else [])
    elif kind in ("current-sensor", "position-sensor"):
        keys = [rng.choice(keys)]
    elif kind == "amplifier-off":
        keys = rng.choice([[], ["duration"]])
    for key in keys:
        value = fault_value(rng, faults[kind][key])
        fault["parameters"][key] = value * duration / 1e3 if key == "duration" else value
    if not fault["parameters"]:
        fault.pop("parameters")
    return fault


def draw_excitation(rng, parts, state, pwm, duration):
    clamped = state == "clamped"
    port = rng.choice(["current", "duty"] if clamped else ["force", "reference", "force", "reference", "current"])
    size = {"force": 20, "reference": 1e-4, "current": 1.0, "duty": 0.5}[port]
    kind = rng.choice(["step", "pulse", "ramp", "sine", "multisine", "chirp"])
    top = 0.4 * pwm
    out = {"target": rng.choice(parts.axes if port in ("force", "reference") else parts.coils), "port": port,
           "kind": kind, "amplitude": max(-1.0, min(1.0, rng.gauss(0, size))) if port == "duty" else
           rng.gauss(0, size), "start": number(rng.uniform(0, 0.9 * duration))}
    if kind == "sine":
        out["frequency"] = number(min(top, 10 ** rng.uniform(0, 4)))
    elif kind == "multisine":
        out["frequencies"] = sorted({number(min(top, 10 ** rng.uniform(0, 4))) for _ in range(4)})
    elif kind == "chirp":
        out["f0"], out["f1"] = number(min(top, 1 + rng.random())), number(min(top, 10 ** rng.uniform(1, 4)))
    if kind == "pulse" or rng.random() < 0.5:
        out["stop"] = number(min(duration, out["start"] + rng.uniform(0.05, 1) * duration))
    return out


def draw_load(rng, parts, duration):
    plane = rng.choice(parts.names)
    force = [rng.gauss(0, 100), rng.gauss(0, 100)] if plane in parts.radial else rng.gauss(0, 100)
    return {"plane": plane, "start": number(rng.uniform(0, duration)), "force": force}


def draw_state(rng, rig, parts, far):
    can_rest = all("auxiliary" in b for b in rig["bearings"].values()) and len(parts.radial) >= 1
    state = rng.choices(["levitated", "resting", "clamped"], [10 if far.share > 0.1 else 45, 25 if can_rest else 0, 30])[0]
    start = {"state": state}
    if state == "clamped" and rng.random() < 0.7:
        start["position"] = {}
        for bearing in rig["bearings"]:
            if bearing in parts.radial and rig["bearings"][bearing].get("kind") != "opposed":
                gap = rig["bearings"][bearing].get("gap", 3e-4)
                start["position"][bearing] = [number(rng.uniform(-0.4, 0.4) * gap) for _ in range(2)]
    return state, start


def draw_scenario(rng, rig, parts, faults, far):
    state, start = draw_state(rng, rig, parts, far)
    most = within_cost(rng, rig, parts, state, far)
    pwm = rig["amplifier"]["switching_frequency"]
    duration = min(rng.choice([50, 200, 800, 3000]), max(20, int(most))) / pwm
    speed = [[0.0, rng.choice([0.0, number(10 ** rng.uniform(0, 4))])]]
    if rng.random() < 0.3:
        speed.append([duration, number(10 ** rng.uniform(0, 4))])
    scenario = {
        "name": "random", "rig": "rig.toml", "duration": duration,
        "record_rate": pwm / rng.choice([1, 2, 5, 10]), "seed": rng.randrange(2**31),
        "noise": rng.random() < 0.8, "fault_tolerance": rng.random() < 0.8, "start": start, "speed": {"profile": speed},
    }
    if rng.random() < 0.1 and len(parts.axes) > 1 and state != "clamped":
        scenario["speed"]["free_from"] = number(rng.uniform(0, duration))
    if rng.random() < 0.1:
        scenario["redistribution"] = rng.choice(["auto", "matrix", "force-by-force"])
    if state != "clamped" and rng.random() < 0.5:
        scenario["load"] = [draw_load(rng, parts, duration)]
    if rng.random() < (0.9 if state == "clamped" else 0.4):
        scenario["excitation"] = [draw_excitation(rng, parts, state, pwm, duration)]
    count = rng.choice([0, 1, 1, 2, 3])
    if count:
        scenario["fault"] = [draw_fault(rng, parts, faults, duration) for _ in range(count)]
    return scenario


# --- TOML ---------------------------------------------------------------------------------------
def text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return "[" + ", ".join(text(v) for v in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(k)} = {text(v)}" for k, v in value.items()) + " }"
    return json.dumps(value) if isinstance(value, str) else repr(value)


def toml(document):
    """Numbers and texts first, then a line per table: inline tables may stand anywhere."""
    def is_list_of_tables(value):
        return isinstance(value, list) and value and isinstance(value[0], dict)

    lines = [f"{k} = {text(v)}" for k, v in document.items()
             if not isinstance(v, dict) and not is_list_of_tables(v)]
    for key, value in document.items():
        if isinstance(value, dict) and key == "bearings":
            for name, bearing in value.items():
                lines += [f"[bearings.{name}]"] + [f"{k} = {text(v)}" for k, v in bearing.items()]
        elif isinstance(value, dict):
            lines += [f"[{key}]"] + [f"{k} = {text(v)}" for k, v in value.items()]
        elif is_list_of_tables(value):
            for item in value:
                lines += [f"[[{key}]]"] + [f"{k} = {text(v)}" for k, v in item.items()]
    return "\n".join(lines) + "\n"
