"""Programs: named routines over named arrays of variables, from which code is generated."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import singledispatch
from math import prod
from typing import Any, Protocol

from symbody.errors import ProgramError
from symbody.symbolic._core import Expr, free_symbols
from symbody.symbolic.given.namesake import namesake_note

__all__ = ["STAGES", "Argument", "Program", "Programmable", "Result", "Routine", "program_of"]

STAGES = ("parameters", "time and inputs", "positions", "velocities", "accelerations")
"""The inputs that an instruction may depend on, from those that change seldom to those that change in every call."""

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


@dataclass(frozen=True)
class Argument:
    """One input array of a program.

    Attributes:
        name: its name in the code, such as ``q``.
        meaning: what it is, for the reader of the code.
        variables: the variables whose values it holds, in order.
        stage: one of :data:`STAGES`, which says how often the values change.
    """

    name: str
    meaning: str
    variables: tuple[Expr, ...]
    stage: str

    def __post_init__(self) -> None:
        _check_name("argument", self.name)
        if self.stage not in STAGES:
            raise ProgramError(
                f"the argument {self.name} is of the stage {self.stage!r}; expected one of {', '.join(STAGES)}"
            )
        for variable in self.variables:
            if not variable.is_variable:
                raise ProgramError(
                    f"the argument {self.name} holds {variable}; expected symbols, functions of time or their rates"
                )


@dataclass(frozen=True)
class Result:
    """One output of a routine: a scalar with the shape (), a vector (n,), or a matrix (rows, columns) row by row."""

    name: str
    meaning: str
    expressions: tuple[Expr, ...]
    shape: tuple[int, ...]

    def __post_init__(self) -> None:
        _check_name("result", self.name)
        if len(self.shape) > 2 or prod(self.shape) != len(self.expressions):
            raise ProgramError(
                f"the result {self.name} has {len(self.expressions)} expressions and the shape {self.shape}; "
                "expected a scalar (), a vector (n,) or a matrix (rows, columns)"
            )


@dataclass(frozen=True)
class Routine:
    """A function that computes results from some of the program's arguments, which it has by name."""

    name: str
    meaning: str
    arguments: tuple[str, ...]
    results: tuple[Result, ...]

    def __post_init__(self) -> None:
        _check_name("routine", self.name)
        _check_single(f"the results of {self.name}", (result.name for result in self.results))

    @property
    def expressions(self) -> tuple[Expr, ...]:
        """All expressions of the results, one after another."""
        return tuple(expression for result in self.results for expression in result.expressions)


@dataclass(frozen=True)
class Program:
    """Routines with common arguments.

    >>> from symbody.symbolic import Argument, Program, Result, Routine, sin, symbols
    >>> x, a = symbols("x a")
    >>> wave = Routine("wave", "a sine wave", ("p", "q"), (Result("y", "height", (a * sin(x),), ()),))
    >>> parameters, positions = Argument("p", "", (a,), "parameters"), Argument("q", "", (x,), "positions")
    >>> Program("demo", "an example", (parameters, positions), (wave,)).arguments_of(wave) == (parameters, positions)
    True
    """

    name: str
    meaning: str
    arguments: tuple[Argument, ...]
    routines: tuple[Routine, ...]

    def __post_init__(self) -> None:
        _check_name("program", self.name)
        _check_single("the arguments", (argument.name for argument in self.arguments))
        _check_single("the routines", (routine.name for routine in self.routines))
        _check_single_variables([v for argument in self.arguments for v in argument.variables])
        for routine in self.routines:
            _check_closed(routine, self.arguments_of(routine))

    def arguments_of(self, routine: Routine) -> tuple[Argument, ...]:
        """Return the arguments of a routine, in their order."""
        known = {argument.name: argument for argument in self.arguments}
        for name in routine.arguments:
            if name not in known:
                raise ProgramError(
                    f"the routine {routine.name} takes {name}; the program's arguments are {', '.join(known)}"
                )
        return tuple(known[name] for name in routine.arguments)


def _check_closed(routine: Routine, arguments: Iterable[Argument]) -> None:
    """Raise an error for a result that contains a variable that is not among the arguments."""
    given = {variable for argument in arguments for variable in argument.variables}
    for result in routine.results:
        leaves = free_symbols(result.expressions)
        missing = sorted(str(leaf) for leaf in leaves - given)
        if missing:
            names = ", ".join(argument.name for argument in arguments)
            raise ProgramError(
                f"the result {result.name} of {routine.name} contains {', '.join(missing)}, and is not a function of "
                f"its arguments {names}; substitute a value, or make it a parameter or an input"
                f"{namesake_note(leaves - given, given, ('in the result', 'among the arguments'))}"
            )


def _check_name(kind: str, name: str) -> None:
    if not _NAME.fullmatch(name):
        raise ProgramError(
            f"the name {name!r} of the {kind} can't be used in code; expected letters, digits and _ after a letter"
        )


def _check_single_variables(variables: Sequence[Expr]) -> None:
    """Raise an error for variables with the same name, equal or with different assumptions."""
    names = [str(variable) for variable in variables]
    for name, count in Counter(names).items():
        same = [variable for variable in variables if count > 1 and str(variable) == name]
        same.sort(key=lambda variable: getattr(variable, "assumption", ""))
        note = namesake_note(same[:1], same[1:], ("in one place", "in another"))
        if note:
            raise ProgramError(f"the variables have the name {name} {count} times{note}")
    _check_single("the variables", names)


def _check_single(kind: str, names: Iterable[str]) -> None:
    for name, count in Counter(names).items():
        if count > 1:
            raise ProgramError(f"{kind} have the name {name} {count} times; give each a name of its own")


class Programmable(Protocol):
    """Anything of which a program can be made, such as the equations of motion."""

    def program(self) -> Program:
        """Return the program."""
        ...


@singledispatch
def program_of(model: Any, **_options: Any) -> Program:
    """Return the program of a model; a program is its own.

    Layers above register how the program of their models is made, with options of their own.

    Raises:
        ProgramError: no program can be made of the model.
    """
    if hasattr(model, "program"):
        program = model.program()
        if isinstance(program, Program):
            return program
    raise ProgramError(
        f"generate: {type(model).__name__} has no program; expected a Program, or equations of motion as "
        "lagrange_equations(system) returns them"
    )


@program_of.register
def _program_itself(model: Program) -> Program:
    return model
