"""The commands of ambrig as functions: options by their names, answers as dictionaries.

Every function takes the options of the command as keywords, with _ for - (`ambrig COMMAND --help` lists
them): `explain("case.toml", candidates=3)` is `ambrig explain case.toml --candidates 3`. A flag is True, an
option that is given twice a list. `progress` is called with the fraction that is done; Ctrl-C ends the work
within a second. Raises InputError, NoSolution, KeyboardInterrupt.
"""
from __future__ import annotations

import json
import os
import tempfile
from typing import Any

from . import _core
from .document import Rig
from .record import ProgressCall

Path = str | os.PathLike[str]


class Answer(dict[str, Any]):
    """The JSON of a command; `text` is what it printed, `exit_code` 0, or 1 when an expectation was not met."""

    text: str
    exit_code: int


def _options(options: dict[str, Any]) -> list[str]:
    out: list[str] = []
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        if value is True:
            out.append(flag)
        elif value is not False and value is not None:
            for one in value if isinstance(value, (list, tuple)) else [value]:
                out += [flag, os.fspath(one) if isinstance(one, os.PathLike) else str(one)]
    return out


def call(command: str, *arguments: Path, progress: ProgressCall | None = None, **options: Any) -> Answer:
    """Any command of `ambrig` that has --json."""
    with tempfile.TemporaryDirectory(prefix="ambrig_") as folder:
        file = os.path.join(folder, "answer.json")
        words = [command, *[os.fspath(a) for a in arguments], *_options(options), "--json", file]
        code, text = _core.command(words, progress)
        answer = Answer()
        if os.path.exists(file):
            with open(file, encoding="utf-8") as stream:
                content = json.load(stream)
            answer.update(content if isinstance(content, dict) else {"rows": content})
    answer.text = text
    answer.exit_code = code
    return answer


def _on_rig(command: str, rig: Rig | Path, progress: ProgressCall | None, options: dict[str, Any]) -> Answer:
    if not isinstance(rig, Rig):
        return call(command, rig, progress=progress, **options)
    with tempfile.TemporaryDirectory(prefix="ambrig_") as folder:
        file = os.path.join(folder, os.path.basename(rig.file))
        rig.save(file)
        return call(command, file, progress=progress, **options)


def analyze(rig: Rig | Path, *, progress: ProgressCall | None = None, **options: Any) -> Answer:
    """Modes, margins, sensitivity, unbalance of a rig."""
    return _on_rig("analyze", rig, progress, options)


def redistribute(rig: Rig | Path, *, progress: ProgressCall | None = None, **options: Any) -> Answer:
    """Currents after coil failures: `redistribute(rig, bearing="A", failed="1,2")`."""
    return _on_rig("redistribute", rig, progress, options)


def compare(case: Path, *, progress: ProgressCall | None = None, **options: Any) -> Answer:
    """Where model and measurement part, block by block."""
    return call("compare", case, progress=progress, **options)


def explain(case: Path, *, progress: ProgressCall | None = None, **options: Any) -> Answer:
    """Which physical effect is missing."""
    return call("explain", case, progress=progress, **options)


def adopt(case: Path, effect: str, *, output: Path, progress: ProgressCall | None = None, **options: Any) -> Answer:
    """A rig file with the effect, calibrated, written to `output`."""
    return call("adopt", case, effect, output=output, progress=progress, **options)


def refine(case: Path, what: str, *, output: Path, progress: ProgressCall | None = None, **options: Any) -> Answer:
    """The shape of an effect's law from the records: `refine(case, "saturation@A", output=...)`."""
    return call("refine", case, what, output=output, progress=progress, **options)


def plan(case: Path, *, output: Path, progress: ProgressCall | None = None, **options: Any) -> Answer:
    """The scenario to measure next, written to `output`."""
    return call("plan", case, output=output, progress=progress, **options)


def campaign(file: Path, *, output: Path, progress: ProgressCall | None = None, **options: Any) -> Answer:
    """Runs of a campaign on all cores; table.csv and report.html in the folder `output`."""
    return call("campaign", file, out=output, progress=progress, **options)


def check(*files: Path, progress: ProgressCall | None = None, **options: Any) -> Answer:
    """Scenarios with [expect]; exit_code 1 when one is not met."""
    return call("check", *files, progress=progress, **options)


def export(rig: Rig | Path, *, progress: ProgressCall | None = None, **options: Any) -> Answer:
    """The rig for other programs: `export(rig, controller_c="controller.c")`."""
    return _on_rig("export", rig, progress, options)
