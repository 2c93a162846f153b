"""Responses are of an output to an input: where a pair of names stands in the arrays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from symbody.errors import ArgumentError
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described

__all__ = ["output_and_input"]


def output_and_input(
    where: str, names: Any, outputs: Sequence[str], inputs: Sequence[Expr]
) -> tuple[int, int]:
    """Return the places of an output and of an input.

    Args:
        where: the class of the response, for messages.
        names: the output, by its name or as an expression, and the input.
        outputs: the names of all outputs.
        inputs: all inputs.

    Raises:
        ArgumentError: the names are no such pair.
    """
    if not isinstance(names, tuple) or len(names) != 2:
        raise ArgumentError(
            f"{where}: {described(names)}; expected an output and an input, such as "
            f"response[{outputs[0]!r}, {inputs[0]}]"
        )
    output, r = names
    if str(output) not in outputs or r not in inputs:
        raise ArgumentError(
            f"{where}: [{output}, {r}] is not known; expected one of the outputs {', '.join(outputs)} and one of the "
            f"inputs {', '.join(map(str, inputs))}"
        )
    return outputs.index(str(output)), inputs.index(r)
