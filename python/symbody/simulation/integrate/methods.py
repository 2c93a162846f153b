"""The methods of integration, one row for each."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from symbody.errors import SimulationError
from symbody.symbolic.given.wording import joined_by_and

from . import ida_method, native
from .task import Method

__all__ = ["DEFAULT", "METHODS", "check_abilities", "method_name", "methods_that"]

DEFAULT = "dop853"
"""The method that "auto" selects."""


def _native(*, is_explicit: bool) -> Method:
    return Method(
        partial(native.prepare, needs_jacobian=not is_explicit),
        is_explicit=is_explicit,
        keeps_branch=is_explicit,
        enforces_constraints=True,
        locates_events=True,
        integrates_work=True,
        integrates_sensitivities=True,
    )


def _ida(form: str) -> Method:
    return Method(partial(ida_method.prepare, form=form), enforces_constraints=True, locates_events=True)


METHODS = {
    "dop853": _native(is_explicit=True),
    "tsit5": _native(is_explicit=True),
    "bdf": _native(is_explicit=False),
    "esdirk34": _native(is_explicit=False),
    "tr_bdf2": _native(is_explicit=False),
    "ida": _ida("stabilized"),
    "ida2": _ida("2"),
    "ida3": _ida("3"),
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


def methods_that(can: Callable[[Method], bool]) -> list[str]:
    """Return the names of the methods for which a condition holds, in quotes.

    >>> methods_that(lambda method: not method.integrates_work)
    ["'ida'", "'ida2'", "'ida3'"]
    """
    return [repr(name) for name, method in METHODS.items() if can(method)]


def check_abilities(
    name: str, *, has_events: bool, is_projected: bool, has_sensitivities: bool = False, where: str
) -> None:
    """Check that a method can do what a task needs.

    Args:
        name: the method by name.
        has_events: whether there are events to watch.
        is_projected: whether there are constraints, and constraints="projection".
        has_sensitivities: whether the state is differentiated by parameters.
        where: the function that the user called, for messages.

    Raises:
        SimulationError: the method cannot do it; the message names those that can.
    """
    method = METHODS[name]
    if has_events and not method.locates_events:
        able = joined_by_and(methods_that(lambda other: other.locates_events), most=len(METHODS))
        raise SimulationError(
            f"{where}, events: method={name!r} doesn't locate events; leave them out, or use a method that does: {able}"
        )
    if has_sensitivities and not method.integrates_sensitivities:
        able = joined_by_and(methods_that(lambda other: other.integrates_sensitivities), most=len(METHODS))
        raise SimulationError(
            f"{where}, sensitivities: method={name!r} doesn't integrate them; leave them out, or use a method that "
            f"does: {able}"
        )
    if is_projected and not method.enforces_constraints:
        able = joined_by_and(methods_that(lambda other: other.enforces_constraints), most=len(METHODS))
        raise SimulationError(
            f"{where}: method={name!r} doesn't enforce constraints by itself; use constraints='baumgarte', or a method "
            f"that does: {able}"
        )
