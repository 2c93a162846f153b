"""Reading results: expressions in the brackets of a motion and in the list of `evaluate`; the rest is explained."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from numbers import Number
from typing import NoReturn

from symbody.errors import ArgumentError
from symbody.geometry import Point, Vector
from symbody.symbolic import Expr, Matrix
from symbody.symbolic.given.arguments import brief, described, expression

__all__ = ["Reading"]


@dataclass(frozen=True)
class Reading:
    """How the messages of a result speak of it.

    Attributes:
        name: what a user calls it, such as ``motion``.
        rows: how to get at one instant, or at one case, and at several.
    """

    name: str
    rows: str

    def one(self, wanted: object, known: Sequence[Expr]) -> Expr:
        """Return the expression in the brackets.

        Args:
            wanted: what stands there.
            known: variables of this model, for an example.

        Raises:
            ArgumentError: it is no expression. Numbers are none here: they look like the index of a row.

        >>> Reading("motion", "motion.t has the instants").one(0, [])
        Traceback (most recent call last):
        symbody.errors.ArgumentError: motion[...]: 0 is an int; expected an expression; motion.t has the instants
        """
        if isinstance(wanted, Expr):
            return wanted
        example = f", such as {self.name}[{known[0]}]" if known else ""
        raise ArgumentError(
            f"{self.name}[...]: {_found(wanted)}; expected an expression{example}{self._instead_of_one(wanted)}"
        )

    def several(self, wanted: object) -> list[Expr]:
        """Return the expressions of a list.

        Raises:
            ArgumentError: it is no list, or holds something that is no expression and no number.
        """
        place = f"{self.name}.evaluate"
        if isinstance(wanted, Expr | str | Mapping) or not isinstance(wanted, Iterable):
            raise ArgumentError(
                f"{place}: {_found(wanted)}; expected a list of expressions{self._instead_of_several(wanted)}"
            )
        listed = list(wanted)
        for item in listed:
            if isinstance(item, Point | Vector | Matrix):
                raise ArgumentError(
                    f"{place}: {_found(item)}; expected expressions in the list{self._instead_of_one(item)}"
                )
        return [expression(item, place) for item in listed]

    def refuse_iteration(self) -> NoReturn:
        """Raise the error of a loop over a result.

        Raises:
            ArgumentError: always.
        """
        raise ArgumentError(f"{self.name}: nothing to go through one by one; {self.rows}")

    def _instead_of_one(self, wanted: object) -> str:
        """Return the way to what was probably meant."""
        if isinstance(wanted, Number | slice):
            return f"; {self.rows}"
        if isinstance(wanted, Point | Vector):
            return f"; {self._components(wanted)}"
        if isinstance(wanted, Matrix):
            return f"; its entries are expressions: {self.name}.evaluate([*matrix])"
        if isinstance(wanted, Iterable) and not isinstance(wanted, str | Mapping):
            return f"; several at once: {self.name}.evaluate([...])"
        return ""

    def _instead_of_several(self, wanted: object) -> str:
        if isinstance(wanted, Point | Vector):
            return f"; {self._components(wanted)}"
        if isinstance(wanted, Mapping):
            return f", such as its values: {self.name}.evaluate([*expressions.values()])"
        if isinstance(wanted, Expr):
            return f", such as {self.name}.evaluate([{brief(wanted)}]); for one of them {self.name}[{brief(wanted)}]"
        return ""

    def _components(self, wanted: Point | Vector) -> str:
        what, name = ("coordinates", "point") if isinstance(wanted, Point) else ("components", "vector")
        return f"its {what} in a frame are expressions: {self.name}.evaluate({name}.projected(frame).{what})"


def _found(wanted: object) -> str:
    """Return what was found in words; expressions are called so."""
    return f"{brief(wanted)} is one expression" if isinstance(wanted, Expr) else described(wanted)
