"""Records: channels on one time base, as NumPy arrays."""
from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from .document import Rig, Scenario, load_rig, load_scenario

if TYPE_CHECKING:
    import xarray

Array = npt.NDArray[np.float64]
ProgressCall = Callable[[float], object]


class Record(Mapping[str, Array]):
    """Channels by name; each is an array of its own, in SI units (`units`)."""

    def __init__(self, raw: dict[str, Any]) -> None:
        self._raw = raw

    def __getitem__(self, channel: str) -> Array:
        found: Array = self._raw["channels"][channel][1]
        return found

    def __iter__(self) -> Iterator[str]:
        return iter(self._raw["channels"])

    def __len__(self) -> int:
        return len(self._raw["channels"])

    @property
    def units(self) -> dict[str, str]:
        """Unit of every channel."""
        return {name: unit for name, (unit, _) in self._raw["channels"].items()}

    @property
    def rate(self) -> float:
        """Rows per second [Hz]."""
        return float(self._raw["rate"])

    @property
    def time(self) -> Array:
        """Time of every row [s]."""
        rows = len(next(iter(self.values()))) if len(self) else 0
        return np.asarray(self._raw["start"] + np.arange(rows) / self._raw["rate"], dtype=np.float64)

    @property
    def attributes(self) -> dict[str, str]:
        """Texts that the record carries: rig, scenario, ..."""
        return dict(self._raw["attributes"])

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes HDF5, as `ambrig run` does."""
        _core.write_hdf5(self._raw, os.fspath(file))

    def to_xarray(self) -> xarray.Dataset:
        """A Dataset over the dimension `time` with the attribute `units` at every variable."""
        import xarray

        time = xarray.DataArray(self.time, dims="time", attrs={"units": "s"})
        variables = {name: ("time", self[name], {"units": unit}) for name, unit in self.units.items()}
        return xarray.Dataset(variables, coords={"time": time}, attrs=self.attributes)

    def plot_orbit(self, bearing: str, ax: Any = None, start: float = 0.0, stop: float = np.inf) -> Any:
        """The shaft's path at a bearing, x against y in micrometres, from `start` to `stop` [s]; on Matplotlib
        axes `ax` or new ones, which are returned."""
        if ax is None:
            import matplotlib.pyplot

            _, ax = matplotlib.pyplot.subplots()
        for name in (bearing + ".x", bearing + ".y"):
            if name not in self:
                known = sorted({n.split(".")[0] for n in self if n.endswith(".y")})
                raise KeyError(f"{name} is not in the record, allowed: {', '.join(known)}")
        inside = (self.time >= start) & (self.time <= stop)
        ax.plot(self[bearing + ".x"][inside] * 1e6, self[bearing + ".y"][inside] * 1e6, linewidth=0.8)
        ax.set_aspect("equal", "datalim")
        ax.set_xlabel(f"{bearing}.x [µm]")
        ax.set_ylabel(f"{bearing}.y [µm]")
        ax.set_title(f"orbit at {bearing}")
        return ax


class Run(Record):
    """What a run gave: its record and, in `result`, what `ambrig run --json` writes."""

    def __init__(self, raw: dict[str, Any], result: dict[str, Any]) -> None:
        super().__init__(raw)
        self.result = result

    @property
    def events(self) -> list[dict[str, Any]]:
        """What happened when."""
        return list(self.result.get("events", []))

    @property
    def metrics(self) -> dict[str, Any]:
        return dict(self.result.get("metrics", {}))

    @property
    def verdict(self) -> dict[str, bool]:
        """Whether the rotor touched down, and whether it dropped."""
        return {"touchdown": bool(self.result["touchdown"]), "drop": bool(self.result["drop"])}

    def __repr__(self) -> str:
        return f"<ambrig.Run of {self.result['name']!r}: {len(self)} channels>"


def run(scenario: Scenario | str | os.PathLike[str], rig: Rig | str | os.PathLike[str] | None = None, *,
        fidelity: str = "switching", rate: float = 0.0, progress: ProgressCall | None = None) -> Run:
    """Simulates a scenario: the numbers of `ambrig run`, bit by bit.

    rig       instead of the scenario's own
    fidelity  "switching", "reference" or "averaged"
    rate      rows of the record per second [Hz]; 0: the scenario's
    progress  called now and then with the fraction that is done

    Other Python threads go on meanwhile; Ctrl-C ends the run within a fraction of a second.
    Raises InputError, NoSolution, KeyboardInterrupt.
    """
    if rig is not None and not isinstance(rig, Rig):
        rig = load_rig(rig)
    if not isinstance(scenario, Scenario):
        scenario = load_scenario(scenario, rig)
    elif rig is not None and rig is not scenario.rig:
        scenario = Scenario(scenario.text, scenario.file, rig)
    else:
        scenario._check()  # its rig may have been edited since
    raw, text = _core.run(scenario.rig._core, scenario._core, fidelity, rate, progress)
    raw["attributes"].update(made_by="ambrig python", scenario=scenario.text, rig=scenario.rig.text, fidelity=fidelity)
    return Run(raw, json.loads(text))


def read(file: str | os.PathLike[str]) -> Record:
    """A record that was written as HDF5, by ambrig or by others."""
    return Record(_core.read_hdf5(os.fspath(file)))
