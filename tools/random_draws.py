"""The draws of tools/random_scenarios.py: a rig file and a scenario file from a random generator.

Every number is drawn near that of an example rig or anywhere in the range that `ambrig parameters`
and `ambrig effects` name for it; kinds (bearings, modulations, modes, detectors, controllers, starts,
faults, excitations, effects) are drawn among all that there are.

A draw is cheap on purpose: `within_cost` bounds what it computes (samples of all coils, and pieces
of a period in contact) for 99 of 100 draws. The others are as slow as they come, up to a bound that
one process still ends within seconds.
"""
import json
import math
import re

from random_rigs import draw_rig, limit
from random_tables import Tables, anywhere, draw_far, number

__all__ = ["Tables", "draw_far", "draw_rig", "draw_scenario", "toml"]

WARM_UP = {"levitated": 0.25, "clamped": 0.03, "resting": 0.0}  # s before t = 0 (simulation/sampled/start_state.h)
CHEAP, SLOW = 4e5, 3e7  # samples of a coil, warm-up included: some 2 and 150 ms
OF_ENGINE = {"switching": 1.0, "averaged": 0.2, "reference": 0.05}  # periods of equal computing


# --- cost ---------------------------------------------------------------------------------------
def within_cost(rng, rig, parts, state, far, fidelity):
    """Lowers the switching frequency and the stiffness of contacts until a run is cheap (docstring)."""
    amplifier, rotor = rig["amplifier"], rig["rotor"]
    slow = rng.random() < 0.01
    most = (SLOW if slow else CHEAP) * OF_ENGINE[fidelity]
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
    pieces = max(8.0, most / 600 / max(1.0, WARM_UP[state] * pwm))
    for bearing in rig["bearings"].values():
        if "auxiliary" not in bearing:
            continue
        if not slow and rng.random() < 0.95:
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


def draw_fault(rng, rig, parts, faults, duration):
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
        if key == "duration":
            value *= duration / 1e3
        if key == "voltage":  # a sag is below the rig's bus
            bus = rig["amplifier"]["bus_voltage"]
            value = min(value, 0.99 * (bus["value"] if isinstance(bus, dict) else bus))
        fault["parameters"][key] = value
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


def draw_scenario(rng, rig, parts, faults, far, fidelity):
    state, start = draw_state(rng, rig, parts, far)
    most = within_cost(rng, rig, parts, state, far, fidelity)
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
        scenario["fault"] = [draw_fault(rng, rig, parts, faults, duration) for _ in range(count)]
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
