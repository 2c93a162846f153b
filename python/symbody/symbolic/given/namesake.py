"""Different variables with the same name, which make a given value seem to be missing."""

from __future__ import annotations

from collections.abc import Iterable

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

__all__ = ["namesake_note"]


def namesake_note(
    needed: Iterable[object], given: Iterable[object], roles: tuple[str, str] = ("without a value", "given")
) -> str:
    """Return a note for a message: which of the ``needed`` variables were ``given`` under the same name; or nothing.

    >>> from symbody import symbols
    >>> print(namesake_note([symbols("m", positive=True)], [symbols("m")])[:78])
    ; the m without a value is symbols('m', positive=True), the m given is symbols
    """
    text = _core.namesakes(_variables(needed), _variables(given), roles)
    return f"; {text}" if text else ""


def _variables(items: Iterable[object]) -> list[Expr]:
    return sorted((item for item in items if isinstance(item, Expr) and item.is_variable), key=str)
