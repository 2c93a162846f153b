"""The methods of integration, one row for each."""

from __future__ import annotations

from functools import partial

from symbody.errors import SimulationError

from . import ida_method, native
from .task import Method

__all__ = ["DEFAULT", "METHODS", "method_name"]

DEFAULT = "dop853"
"""The method that "auto" selects."""

_EXPLICIT = Method(native.prepare, is_explicit=True)
_IMPLICIT = Method(partial(native.prepare, needs_jacobian=True))

METHODS = {
    "dop853": _EXPLICIT,
    "tsit5": _EXPLICIT,
    "bdf": _IMPLICIT,
    "esdirk34": _IMPLICIT,
    "tr_bdf2": _IMPLICIT,
    "ida": Method(ida_method.prepare),
    "ida2": Method(ida_method.prepare),
    "ida3": Method(ida_method.prepare),
}
"""The methods by name."""


def method_name(given: object, where: str) -> str:
    """Return the name of a method.

    Raises:
        SimulationError: there is no such method.
    """
    name = DEFAULT if given == "auto" else given
    if not isinstance(name, str) or name not in METHODS:
        raise SimulationError(f"{where}: method={given!r}; expected auto, {', '.join(METHODS)}")
    return name
