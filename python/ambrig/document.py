"""Rig and scenario files that are edited by the names of their keys."""
from __future__ import annotations

import math
import os
import re
import tomllib
from typing import Any

from . import _core
from .errors import InputError

_STEP = re.compile(r"([^.\[\]]+)|\[(\d+)\]")


def _literal(value: Any) -> str:
    """A Python value as TOML text."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n").replace("\t", "\\t")
        return f'"{escaped}"'
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_literal(str(k))} = {_literal(v)}" for k, v in value.items()) + " }"
    if hasattr(value, "tolist"):  # NumPy's numbers and arrays
        return _literal(value.tolist())
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_literal(v) for v in value) + "]"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        if math.isnan(value):
            raise InputError("a value is nan, allowed: numbers")
        return repr(value) if math.isfinite(value) else ("inf" if value > 0 else "-inf")
    raise TypeError(f"{type(value).__name__} is no value of a TOML file (bool, str, number, list, dict)")


class Document:
    """The text of a TOML file. `d["rotor.mass"]` reads a value, `d["rotor.mass"] = 4.3` changes it in the
    text: comments and order stay, the file on disk too. Lists are indexed: "effect[0].parameters.c"."""

    def __init__(self, text: str, file: str) -> None:
        self._text = text
        self._file = file
        self._check()

    def _check(self) -> None:
        """Reads the text as what it is. Raises InputError."""

    @property
    def text(self) -> str:
        """The file's text with all changes."""
        return self._text

    @property
    def file(self) -> str:
        return self._file

    def __getitem__(self, path: str) -> Any:
        """The value at a path; of a number written { value, sd } the value; what a table takes over
        by `like` counts as its own. Raises KeyError."""
        tree: Any = tomllib.loads(self._text)
        steps = [name or int(index) for name, index in _STEP.findall(path)]
        if not steps:
            raise KeyError(path)
        value = self._walk(tree, steps, tree, path)
        return value["value"] if isinstance(value, dict) and "value" in value else value

    def _walk(self, at: Any, steps: list[Any], siblings: Any, path: str) -> Any:
        if not steps:
            return at
        step = steps[0]
        try:
            return self._walk(at[step], steps[1:], at, path)
        except (KeyError, IndexError, TypeError):
            if isinstance(at, dict) and "like" in at and step not in at:
                return self._walk(siblings[at["like"]], steps, siblings, path)
            raise KeyError(path) from None

    def __setitem__(self, path: str, value: Any) -> None:
        """Raises InputError, and changes nothing, for a path or value that is not allowed."""
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            try:  # a tolerance stays: { value = ..., sd = ... }
                raw: Any = self._raw(path)
                if isinstance(raw, dict) and "value" in raw:
                    value = {**raw, "value": float(value)}
            except KeyError:
                pass
        before = self._text
        self._text = _core.edited(self._text, self._file, path, _literal(value))
        try:
            self._check()
        except Exception:
            self._text = before
            raise

    def _raw(self, path: str) -> Any:
        at: Any = tomllib.loads(self._text)
        for name, index in _STEP.findall(path):
            try:
                at = at[name or int(index)]
            except (KeyError, IndexError, TypeError):
                raise KeyError(path) from None
        return at

    def __contains__(self, path: object) -> bool:
        try:
            self[str(path)]
        except KeyError:
            return False
        return True

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the text; files that it names relative to its old place are named absolutely. The file is
        complete or is not there."""
        target = os.fspath(file)
        text = self._text
        if os.path.dirname(os.path.abspath(target)) != os.path.dirname(os.path.abspath(self._file)):
            text = _core.with_absolute_files(text, self._file)
        temporary = f"{target}.{os.getpid()}.tmp"
        with open(temporary, "w", encoding="utf-8") as out:
            out.write(text)
        os.replace(temporary, target)


class Rig(Document):
    """A rig: `rig["bearings.A.gap"] = 5.0e-4`. Made by ambrig.load."""

    _core: _core.Rig

    def _check(self) -> None:
        self._core = _core.Rig(self._text, self._file)

    @property
    def name(self) -> str:
        return self._core.name

    @property
    def axes(self) -> list[str]:
        """Controlled axes, in the order of the controller."""
        return self._core.axes

    def copy(self) -> Rig:
        """Another rig with the same text, to be changed by itself."""
        return Rig(self._text, self._file)

    def __repr__(self) -> str:
        return f"<ambrig.Rig {self.name!r} of {self._file}, axes {', '.join(self.axes)}>"


class Scenario(Document):
    """A scenario on a rig: `scenario["duration"] = 0.5`. Made by ambrig.load."""

    _core: _core.Scenario

    def __init__(self, text: str, file: str, rig: Rig | None = None) -> None:
        if rig is None:
            rig_file = _core.rig_of_scenario(file)
            with open(rig_file, encoding="utf-8") as stream:
                rig = Rig(stream.read(), rig_file)
        self.rig = rig
        super().__init__(text, file)

    def _check(self) -> None:
        self._core = _core.Scenario(self._text, self._file, self.rig._core)

    @property
    def name(self) -> str:
        return self._core.name

    def copy(self) -> Scenario:
        """Another scenario with the same text, on a rig of its own."""
        return Scenario(self._text, self._file, self.rig.copy())

    def __repr__(self) -> str:
        return f"<ambrig.Scenario {self.name!r} of {self._file}, rig {self.rig.name!r}>"


def load(file: str | os.PathLike[str], rig: Rig | None = None) -> Rig | Scenario:
    """A rig file or a scenario file, whichever it is; a scenario's own rig unless `rig` is given."""
    name = os.fspath(file)
    try:
        with open(name, encoding="utf-8") as stream:
            text = stream.read()
    except FileNotFoundError:
        raise InputError(f"{name}: no such file") from None
    except UnicodeDecodeError:
        raise InputError(f"{name}: not a text file") from None
    if re.search(r"^\s*\[\s*rotor\s*\]|^\s*rotor\s*[.=]", text, re.MULTILINE):
        return Rig(text, name)
    return Scenario(text, name, rig)


def load_rig(file: str | os.PathLike[str]) -> Rig:
    """A rig file. Raises InputError for another one."""
    found = load(file)
    if not isinstance(found, Rig):
        raise InputError(f"{found.file}: a scenario, allowed: a rig file")
    return found


def load_scenario(file: str | os.PathLike[str], rig: Rig | None = None) -> Scenario:
    """A scenario file. Raises InputError for another one."""
    found = load(file, rig)
    if not isinstance(found, Scenario):
        raise InputError(f"{found.file}: a rig, allowed: a scenario file")
    return found
