"""What can go wrong: a mistake in a file or an option, and numbers without a solution."""
from __future__ import annotations

import re

from . import _core

_PLACE = re.compile(r"^(?P<file>.+?):(?P<line>\d+): ")


class InputError(ValueError):
    """A mistake in what was given: one line that names file, line, key, value and what is allowed.

    Attributes
    ----------
    file : the file that the message names, or None
    line : the line in it, from 1, or None
    """

    @property
    def file(self) -> str | None:
        found = _PLACE.match(str(self))
        return found["file"] if found else None

    @property
    def line(self) -> int | None:
        found = _PLACE.match(str(self))
        return int(found["line"]) if found else None


class NoSolution(ArithmeticError):
    """An integrator or a solver gave up: numbers for which there is no solution within the tolerances."""


_core.set_exceptions(InputError, NoSolution)
