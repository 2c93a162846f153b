"""Calls: a routine calls an earlier one instead of repeating its work."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from symbody.codegen.straight_line.code import Code, Input, code_of
from symbody.codegen.straight_line.instruction import renumber
from symbody.symbolic import Argument, Program, Routine

__all__ = ["Call", "call_in"]

_EXTRA = 1.1
"""The relative growth of a routine that a call may cause, since the called routine may compute more than is needed."""


@dataclass(frozen=True)
class Call:
    """The routine that is called, and the code that remains.

    Attributes:
        routine: the routine that is called.
        rest: the remaining code. Entries of the results of the call are inputs of it, in an array that is named after
            the routine and the result, such as ``forward_dynamics.a``.
    """

    routine: Routine
    rest: Code


def call_in(program: Program, number: int, codes: Sequence[Code]) -> Call | None:
    """Return the call that saves a routine most of its work, if there is one.

    The routine that is called comes earlier, takes only arguments that the caller has, and returns vectors.

    Args:
        program: the routines.
        number: the number of the routine that may call another one.
        codes: the code of each routine, up to this one.
    """
    routine, whole = program.routines[number], len(codes[number].instructions)
    arguments, least = program.arguments_of(routine), _EXTRA * whole
    best: Call | None = None
    for earlier, code in zip(program.routines[:number], codes, strict=False):
        own = len(code.instructions)
        if not whole or own > least or own < whole / 2 or not _is_callable(earlier, routine):
            continue
        rest = _rest(arguments, routine, earlier)
        if own + len(rest.instructions) <= least:
            best, least = Call(earlier, rest), own + len(rest.instructions)
    return best


def _is_callable(earlier: Routine, routine: Routine) -> bool:
    """Whether a routine can be called from another one, and has a result that is part of the other's."""
    needed = set(routine.expressions)
    are_vectors = all(len(result.shape) == 1 for result in earlier.results)
    is_part = any(needed.issuperset(result.expressions) for result in earlier.results if result.expressions)
    return are_vectors and is_part and set(earlier.arguments) <= set(routine.arguments)


def _rest(arguments: Sequence[Argument], routine: Routine, earlier: Routine) -> Code:
    """Return the code of a routine, given the results of an earlier one."""
    known = {
        expression: Input(f"{earlier.name}.{result.name}", index, "")
        for result in earlier.results
        for index, expression in enumerate(result.expressions)
        if not expression.is_variable and not expression.is_number
    }
    given = dict.fromkeys(expression for expression in routine.expressions if expression in known)
    numbers = {expression: number for number, expression in enumerate(given)}
    return _with_inputs(
        code_of(arguments, [e for e in routine.expressions if e not in known]),
        [known[expression] for expression in given],
        [numbers.get(e) for e in routine.expressions],
    )


def _with_inputs(code: Code, inputs: Sequence[Input], results: Sequence[int | None]) -> Code:
    """Return the code with further inputs; each result is one of these, by number, or the next of its own results."""
    first, own = code.first_instruction, iter(code.results)
    after = range(first + len(inputs), first + len(inputs) + len(code.instructions))
    places = [*range(first), *after]
    return replace(
        code,
        inputs=(*code.inputs, *inputs),
        instructions=renumber(code.instructions, places),
        results=tuple(places[next(own)] if number is None else first + number for number in results),
    )
