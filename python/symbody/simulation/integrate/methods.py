"""The methods of integration, a row for each."""

from __future__ import annotations

from functools import partial

from symbody.errors import SimulationError

from . import by_ida, native
from .task import Method

__all__ = ["DEFAULT", "METHODS", "method_name"]

DEFAULT = "dop853"
"""What "auto" stands for."""

METHODS = {
    "dop853": Method(native.prepare, is_explicit=True),
    "tsit5": Method(native.prepare, is_explicit=True),
    "bdf": Method(partial(native.prepare, needs_jacobian=True)),
    "esdirk34": Method(partial(native.prepare, needs_jacobian=True)),
    "tr_bdf2": Method(partial(native.prepare, needs_jacobian=True)),
    "ida": Method(by_ida.prepare),
    "ida2": Method(by_ida.prepare),
    "ida3": Method(by_ida.prepare),
}


def method_name(given: object, where: str) -> str:
    """Return the name of a method.

    Raises:
        SimulationError: there is no such method.
    """
    name = DEFAULT if given == "auto" else given
    if not isinstance(name, str) or name not in METHODS:
        raise SimulationError(f"{where}: method={given!r}; expected auto, {', '.join(METHODS)}")
    return name
