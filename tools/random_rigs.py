"""A random rig file near that of an example, for tools/random_draws.py."""
import math
import tomllib

from random_tables import PROJECT, RIGS, WHOLE, anywhere, drawn, number


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
