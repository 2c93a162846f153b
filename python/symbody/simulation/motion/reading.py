"""Access to results: expressions in ``result[...]`` and ``result.evaluate([...])``; anything else is an error."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from numbers import Number
from typing import NoReturn

from symbody.dynamics import Reaction
from symbody.errors import ArgumentError
from symbody.geometry import Point, Vector
from symbody.multibody.joint.freedom import Freedom
from symbody.multibody.joint.joint import Joint
from symbody.multibody.joint.placed_joint import PlacedJoint
from symbody.symbolic import Expr, Matrix
from symbody.symbolic.given.arguments import brief, described, expression

__all__ = ["Reading"]


@dataclass(frozen=True)
class Reading:
    """The wording of messages about one kind of result.

    Attributes:
        name: the name of the result in messages, such as ``motion``.
        rows: a sentence on how to read one instant or one case, and several.
    """

    name: str
    rows: str

    def one_expression(self, wanted: object, known: Sequence[Expr]) -> Expr:
        """Return the expression in the brackets; of a freedom of a joint, its value.

        Args:
            wanted: the argument in the brackets.
            known: variables of the model, for an example.

        Raises:
            ArgumentError: the argument is not an expression. Numbers are refused: they look like the index of a row.

        >>> Reading("motion", "motion.t has the instants").one_expression(0, [])
        Traceback (most recent call last):
        symbody.errors.ArgumentError: motion[...]: 0 is an int; expected an expression; motion.t has the instants
        """
        if isinstance(wanted, Freedom):
            return wanted.value
        if isinstance(wanted, Expr):
            return wanted
        example = f", such as {self.name}[{known[0]}]" if known else ""
        raise ArgumentError(
            f"{self.name}[...]: {_found(wanted)}; expected an expression{example}{self._instead_of_one(wanted)}"
        )

    def several_expressions(self, wanted: object) -> list[Expr]:
        """Return the expressions of a list.

        Raises:
            ArgumentError: the argument is not a list, or holds something other than expressions and numbers.
        """
        place = f"{self.name}.evaluate"
        if isinstance(wanted, Expr | str | Mapping) or not isinstance(wanted, Iterable):
            raise ArgumentError(
                f"{place}: {_found(wanted)}; expected a list of expressions{self._instead_of_several(wanted)}"
            )
        listed = list(wanted)
        for item in listed:
            if isinstance(item, Freedom):
                raise ArgumentError(
                    f"{place}: {item} is a freedom; expected expressions in the list; {self.name}[freedom] has its "
                    "values, and freedom.value is an expression"
                )
            if isinstance(item, Point | Vector | Matrix):
                raise ArgumentError(
                    f"{place}: {_found(item)}; expected expressions in the list{self._instead_of_one(item)}"
                )
        return [expression(item, place) for item in listed]

    def refuse_iteration(self) -> NoReturn:
        """Refuse to iterate over a result.

        Raises:
            ArgumentError: always.
        """
        raise ArgumentError(f"{self.name}: a result can't be iterated over; {self.rows}")

    def _instead_of_one(self, wanted: object) -> str:
        """Return a hint at what was probably meant."""
        if isinstance(wanted, Number | slice):
            return f"; {self.rows}"
        if isinstance(wanted, Point | Vector):
            return f"; {self._components(wanted)}"
        if isinstance(wanted, Reaction):
            return f"; its force and its moment are vectors: {self.name}.evaluate(reaction.force.components)"
        if isinstance(wanted, Joint | PlacedJoint):
            return (
                f"; {self.name}[joint.coordinate] is that of a joint of the tree, and "
                f"{self.name}[mechanism.joint({wanted.name!r}).freedom()] that of any joint with one"
            )
        if isinstance(wanted, Matrix):
            return f"; its entries are expressions: {self.name}.evaluate([*matrix])"
        if isinstance(wanted, Iterable) and not isinstance(wanted, str | Mapping):
            return f"; for several expressions: {self.name}.evaluate([...])"
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
    """Describe the argument; an expression is called one."""
    return f"{brief(wanted)} is one expression" if isinstance(wanted, Expr) else described(wanted)
