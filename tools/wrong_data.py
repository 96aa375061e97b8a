#!/usr/bin/env python3
"""How many errors of the data the gate of compare and explain recognises: right cases, corrupted one
record at a time.

    tools/wrong_data.py --ambrig build/release/ambrig CASE_FOLDER... -o OUT [--kinds unit,sign] [--draws 2]
                        [--records 3] [--explain] [--jobs 1] [--seed 1] [--only-table]

A right case is a folder with case.toml and HDF5 records over time (`ambrig hide`, `ambrig practice`, or a
case of one's own that is known to be right). Of every case, kind and size a record and a column are drawn; the
corrupted case holds that record and `--records` - 1 others. The right case is run too: it must give no
verdict `data`. OUT/results.jsonl holds one line per run and is continued where it stopped; OUT/table.md is
the table. Needs python3-h5py.

A corruption counts by what it changes: rms change over the noise that the gate states for that column. Below
`--gross` floors (10, what the gate calls gross) it is listed apart: nobody can see it in one record.
"""
import argparse, concurrent.futures, hashlib, json, os, pathlib, shutil, subprocess, sys
import tomllib

import h5py
import numpy as np

from data_errors import KINDS, corrupt, kind_of, movement
from wrong_data_table import judged, table


def generator(*key):
    digest = hashlib.sha256(repr(key).encode()).digest()
    return np.random.Generator(np.random.PCG64(int.from_bytes(digest[:8], "little")))


def read_h5(path):
    with h5py.File(path) as f:
        return dict(f.attrs), {n: (np.array(d, dtype=float), d.attrs.get("unit", "")) for n, d in f.items()
                               if isinstance(d, h5py.Dataset)}


def write_h5(path, attributes, columns):
    with h5py.File(path, "w") as f:
        f.attrs.update(attributes)
        for name, (y, unit) in columns.items():
            f.create_dataset(name, data=y.astype(np.float32)).attrs["unit"] = unit


def case_of(folder):
    with open(folder / "case.toml", "rb") as f:
        case = tomllib.load(f)
    case["record"] = [r for r in case["record"] if r.get("kind", "time") == "time" and "channels" not in r]
    return case


def text_of(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(k)} = {text_of(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(text_of, value)) + "]"
    return json.dumps(value)


def write_case(case, records, source, target):
    lines = [f"{k} = {text_of(v)}" for k, v in case.items() if k not in ("record", "nuisance", "rig")]
    rig = os.path.abspath(source / case.get("rig", "rig.toml"))
    lines.insert(0, f"rig = {json.dumps(rig)}")
    if "nuisance" in case:
        lines += ["[nuisance]"] + [f"{k} = {text_of(v)}" for k, v in case["nuisance"].items()]
    for r in records:
        lines += ["[[record]]"] + [f"{k} = {text_of(v)}" for k, v in r.items()]
    (target / "case.toml").write_text("\n".join(lines) + "\n")


def start_state(path):
    with open(path, "rb") as f:
        return tomllib.load(f).get("start", {}).get("state", "levitated")


def prepare(folder, kind, size, draw, options, target):
    """Writes the corrupted case; returns what was done, or None where it cannot be done here."""
    rng = generator(options.seed, folder.name, str(folder.parent), kind, size, draw)
    case = case_of(folder)
    records = case["record"]
    order = rng.permutation(len(records))
    state = {r["data"]: start_state(folder / r["scenario"]) for r in records}
    chosen = records[order[0]]
    rest = [records[k] for k in order[1:]]
    rest.sort(key=lambda r: state[r["data"]] != state[chosen["data"]])  # a like one first: exchanged data
    keep = [chosen] + rest[:options.records - 1] if options.records else [chosen] + rest
    attributes, columns = read_h5(folder / chosen["data"])
    right = {n: c[0].copy() for n, c in columns.items()}
    shown = [n for n in columns if kind_of(n) and movement(columns[n][0]) > 0
             and not (state[chosen["data"]] == "clamped" and kind_of(n) in ("set-point", "reading"))]
    if kind in ("clip", "freeze", "zeroed", "spikes", "quantised", "decimated"):
        shown = [n for n in shown if kind_of(n) not in ("set-point", "bus")]
    kinds = sorted({kind_of(n) for n in shown})
    of_kind = kinds[rng.integers(len(kinds))]
    name = sorted(n for n in shown if kind_of(n) == of_kind)
    name = name[rng.integers(len(name))]
    others = []
    for r in keep[1:]:
        a, c = read_h5(folder / r["data"])
        if state[r["data"]] == state[chosen["data"]] and abs(a["rate"] - attributes["rate"]) < 1e-6:
            others.append(c)
    done = {"case": str(folder), "kind": kind, "size": size, "draw": draw, "record": chosen["data"],
            "state": state[chosen["data"]]}
    target.mkdir(parents=True, exist_ok=True)
    named = [] if kind == "none" else corrupt(kind, size, columns, name, rng, attributes, others)
    if named is None:
        return None
    done["named"] = named if kind == "none" or KINDS[kind][2] else []
    done["column"] = named
    write_h5(target / "wrong.h5", attributes, columns)
    n = len(next(iter(columns.values()))[0])
    done["change"] = {c: float(np.sqrt(np.mean((columns[c][0][:m] - right[c][:m]) ** 2)))
                      for c in columns if c in right and kind_of(c) for m in [min(n, len(right[c]))]}
    listed = []
    for r in keep:
        r = dict(r)
        r["scenario"] = os.path.abspath(folder / r["scenario"])
        r["data"] = str(target / "wrong.h5") if r is not chosen and r["data"] == chosen["data"] \
            else os.path.abspath(folder / r["data"])
        listed.append(r)
    write_case(case, listed, folder, target)
    return done


def run(folder, kind, size, draw, options, floors):
    target = pathlib.Path(options.out) / f"run-{os.getpid()}-{kind}-{abs(hash((str(folder), kind, size, draw)))}"
    try:
        done = prepare(folder, kind, size, draw, options, target)
        if done is None:
            return None
        own = floors[done["record"]]
        done["floors"] = max([v / own[c] for c, v in done.pop("change").items() if own.get(c, 0) > 0], default=0)
        command = [options.ambrig, "explain" if options.explain else "compare", str(target / "case.toml"),
                   "--json", str(target / "out.json")] + ([] if options.explain else ["--no-blocks"])
        answer = subprocess.run(command, capture_output=True, text=True, timeout=1800)
        if answer.returncode != 0:
            done["error"] = answer.stderr.strip()[-300:]
            return done
        with open(target / "out.json") as f:
            out = json.load(f)
        done["data"] = [dict(f, record=os.path.basename(f["record"])) for f in out["data"]]
        if options.explain:
            done["verdict"], done["set"] = out["verdict"], out["set"]
            done["adopted"] = [(e["effect"], e["target"]) for e in out["adopted"]]
            best = out["ranking"][0] if out["ranking"] else None
            done["best"] = [best["effect"], best["probability"]] if best else None
        return done
    finally:
        shutil.rmtree(target, ignore_errors=True)


def right_floors(folder, options):
    """Noise floor of every column of every record of the right case, by compare."""
    target = pathlib.Path(options.out) / f"floors-{hashlib.sha256(str(folder).encode()).hexdigest()[:12]}.json"
    if not target.exists():
        subprocess.run([options.ambrig, "compare", str(folder / "case.toml"), "--no-blocks", "--json", str(target)],
                       check=True, capture_output=True)
    with open(target) as f:
        out = json.load(f)
    floors = {os.path.basename(r["data"]): {c: e["noise"] for c, e in r["channels"].items()} for r in out["records"]}
    return floors, out["data"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="+", type=pathlib.Path)
    parser.add_argument("--ambrig", default="ambrig")
    parser.add_argument("-o", "--out", required=True)
    parser.add_argument("--kinds", default="none," + ",".join(KINDS))
    parser.add_argument("--draws", type=int, default=1)
    parser.add_argument("--records", type=int, default=3, help="records of a corrupted case, 0: all")
    parser.add_argument("--explain", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--gross", type=float, default=10)
    parser.add_argument("--only-table", action="store_true")
    options = parser.parse_args()
    out = pathlib.Path(options.out).resolve()
    options.out = str(out)
    out.mkdir(parents=True, exist_ok=True)
    journal = out / "results.jsonl"
    results = [json.loads(line) for line in journal.read_text().splitlines()] if journal.exists() else []
    known = {(r["case"], r["kind"], r["size"], r["draw"]) for r in results}
    work = [(folder, kind, size, draw) for folder in options.cases for kind in options.kinds.split(",")
            for size in (KINDS[kind][0] if kind in KINDS else [0]) for draw in range(options.draws)]
    work = [] if options.only_table else [w for w in work if (str(w[0]), *w[1:]) not in known]
    floors = {}
    for folder in sorted({w[0] for w in work}):
        floors[folder], faults = right_floors(folder, options)
        for f in faults:
            print(f"{folder}: {f['record']} {f['channel']} {f['fault']}: called wrong as it is", file=sys.stderr)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool, open(journal, "a") as log:
        futures = [pool.submit(run, *w, options, floors[w[0]]) for w in work]
        for k, future in enumerate(concurrent.futures.as_completed(futures)):
            result = future.result()
            if result is None:
                continue
            results.append(result)
            log.write(json.dumps(result) + "\n")
            log.flush()
            print(f"{k + 1}/{len(work)} {result['kind']} {result['size']:.4g} {result['record']} {result['column']} "
                  f"{result['floors']:.3g}: {judged(result)} "
                  f"{[(f['channel'], f['fault']) for f in result.get('data', [])]} {result.get('error', '')}",
                  file=sys.stderr)
    text = table(results, options)
    (out / "table.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
