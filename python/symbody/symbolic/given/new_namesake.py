"""Notices of a second variable of one name, where it is made.

Programs and libraries may use one name for different variables in different places. So a notice compares what one file
(or one session) makes at its top, or what a function makes while it holds the first one; and never what one call makes
each time that it runs, as in a loop over assumptions.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from types import CodeType, FrameType
from typing import NamedTuple, TypeAlias

from symbody.errors import notify
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.given.namesake import namesake_note

__all__ = ["notice_named", "notice_namesakes"]

_EXAMPLE = re.compile(r"\[\d+\]>$")
"""The number of an example, at the end of the name that a doctest gives to its code."""


_Place: TypeAlias = tuple[CodeType, int]
"""Where a variable was made: the number of an instruction in some code."""


class _Scope(NamedTuple):
    """A function of a file; its name is the empty text at the top, also in lambdas and comprehensions there."""

    file: str
    function: str
    is_session: bool


class _Made(NamedTuple):
    """What a scope has made: for each name the variables, each with its first place."""

    scope: _Scope
    by_name: dict[str, list[tuple[Expr, _Place]]]


_MADE: dict[_Scope, _Made] = {}
"""What the scopes have made."""

_MADE_BY: dict[int, tuple[CodeType, _Made]] = {}
"""The same by the id of the code in a scope: to hash code takes long, and models make many variables."""

_NOTICED: set[tuple[Expr, Expr, _Scope]] = set()
"""The pairs of which a function of a file has had a notice."""


def notice_namesakes(variables: Iterable[Expr], where: str, frame: FrameType | None) -> None:
    """Warn, at the user's line, of variables that differ from one of their name that was made before.

    Args:
        variables: variables that were just made; a derivative stands for its function.
        where: the function that the user called, for the notice.
        frame: the frame of the user's line.

    >>> from symbody import symbols
    >>> symbols("u_1") - symbols("u_1", positive=True)  # a notice, outside of doctests
    u_1 - u_1[positive]
    """
    bases = map(_base, variables)
    notice_named((((base.name, base) for base in bases)), where, frame)


def _base(leaf: Expr) -> Expr:
    """Return the function of time of which a leaf is a derivative; another leaf as it is."""
    if leaf.kind != "time_function":
        return leaf
    return _core.time_function(leaf.name, small=leaf.assumption == "small")


def notice_named(variables: Iterable[tuple[str, Expr]], where: str, frame: FrameType | None) -> None:
    """Do what ``notice_namesakes`` does for variables with their names."""
    if frame is None or frame.f_globals.get("__name__") == "doctest":
        return
    made = _made_by(frame)
    here = frame.f_code, frame.f_lasti
    for name, variable in variables:
        known = made.by_name.get(name)
        if known is None:
            made.by_name[name] = [(variable, here)]
        elif len(known) > 1 or known[0][0] != variable:
            _compare(variable, known, here, made.scope, where, frame)


def _compare(
    variable: Expr, made: list[tuple[Expr, _Place]], here: _Place, scope: _Scope, where: str, frame: FrameType
) -> None:
    """Warn if one of the variables of this name that the scope has made before is another one.

    Args:
        variable: the variable that was just made.
        made: the variables of its name, each with its first place.
        here: the place of this one.
        scope: the function of a file around the place.
        where: the function that the user called.
        frame: the frame of the user's line.
    """
    is_new = all(known != variable for known, _ in made)
    others = [(known, at) for known, at in made if known != variable and not _is_same_call(at, here)]
    if scope.function:  # a later call of the function may mean another variable
        others = [(known, at) for known, at in others if _holds(frame.f_locals.values(), known)]
    elif not is_new:
        return
    if is_new:
        made.append((variable, here))
    if others and (variable, others[-1][0], scope) not in _NOTICED:
        known, at = others[-1]
        _NOTICED.add((variable, known, scope))
        before = "made before" if scope.is_session else f"made in line {_line(at)}"
        notify(where + namesake_note([variable], [known], ("made here", before)).replace(";", ":", 1))


def _made_by(frame: FrameType) -> _Made:
    """Return what the scope of the user's line has made."""
    code = frame.f_code
    known = _MADE_BY.get(id(code))
    if known is not None and known[0] is code:
        return known[1]
    names = [name for name in code.co_qualname.split(".") if not name.startswith("<")]
    scope = _Scope(_file(frame), ".".join(names), "__file__" not in frame.f_globals)
    made = _MADE.setdefault(scope, _Made(scope, {}))
    _MADE_BY[id(code)] = (code, made)
    return made


def _is_same_call(one: _Place, other: _Place) -> bool:
    """Whether one call of the program is in both places."""
    return one[0] is other[0] and one[1] == other[1]


def _line(place: _Place) -> int | None:
    """Return the number of the line of a place. Only notices need it, and frames take long to find it."""
    code, instruction = place
    return next((line for start, end, line in code.co_lines() if start <= instruction < end), None)


def _holds(things: Iterable[object], variable: Expr) -> bool:
    """Whether an expression among some things, or in a list of them, contains the variable."""
    listed = [each for thing in things for each in (thing if isinstance(thing, list | tuple) else (thing,))]
    return any(isinstance(thing, Expr) and thing.has(variable) for thing in listed)


def _file(frame: FrameType) -> str:
    """Return what keeps the names of one program together: its file, or the session."""
    names = frame.f_globals
    if "__file__" in names:
        return str(names["__file__"])
    code = frame.f_code.co_filename
    if code.startswith("<doctest"):
        return _EXAMPLE.sub("", code)
    return "__main__" if names.get("__name__") == "__main__" else code
