"""What a statement prints in the program and in the worksheet: loops and procedures print values without a name."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, TextIO

import numpy as np

from symbody.symbolic import Expr
from symbody.worksheet.check.texts import text_difference
from symbody.worksheet.convert.same import same
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.value import Plot, Value
from symbody.worksheet.values.value import Sequence as Values

__all__ = ["Recorder", "prints_the_same", "shown_items"]


class Recorder:
    """A replacement for ``print`` that records what the code of a statement prints."""

    def __init__(self, output: TextIO) -> None:
        self.items: list[Any] = []
        self.length = 0
        self._output = output

    def __call__(self, *items: Any, **options: Any) -> None:
        """Print, and remember what is printed."""
        before = self._output.tell()
        print(*items, **options, file=self._output)
        self.length += self._output.tell() - before
        self.items += items

    @property
    def is_complete(self) -> bool:
        """Whether everything was printed by this recorder; ``show`` prints otherwise."""
        return self.length == self._output.tell()


def shown_items(shown: Iterable[Value | str]) -> Iterator[Value | str]:
    """Yield the values and texts that the worksheet has printed, one by one."""
    for each in shown:
        if isinstance(each, Values):
            yield from shown_items(each.items)
        else:
            yield each


def prints_the_same(
    session: Session, recorder: Recorder, statement: syntax.Statement, small: Mapping[Expr, Expr]
) -> bool:
    """Whether the program prints the values that the worksheet prints, and no others.

    What a command prints besides its value, as ``linear_modeling`` does, is not compared.
    """
    found = [*shown_items(session.shown)]
    if isinstance(statement, syntax.Evaluation) and not recorder.items:
        return True
    if not recorder.is_complete or any(isinstance(each, Plot) for each in found):
        return True  # what is drawn, or shown in a form of its own, has no values to compare
    left = [one for each in recorder.items for one in _items(each)]
    for value in found:
        place = next((k for k, one in enumerate(left) if _is_alike(session, one, value, small)), None)
        if place is None:
            return False
        del left[place]  # the items of a set are printed in another order
    return not left


def _items(made: Any) -> Iterable[Any]:
    """Return what is printed as one value, or the numbers of an array, which the worksheet prints as a sequence."""
    return made.ravel() if isinstance(made, np.ndarray) else (made,)


def _is_alike(session: Session, made: Any, value: Value | str, small: Mapping[Expr, Expr]) -> bool:
    if isinstance(value, str):
        return _same_text(value, str(made))
    return same(session, made, value, small)


def _same_text(sheet: str, program: str) -> bool:
    """Whether texts are the same; expressions in them are written in the notations of Maple and Python."""
    return not text_difference(_without_blanks(sheet), _without_blanks(program))


def _without_blanks(text: str) -> str:
    return re.sub(r" *([-+*/^]) *", r"\1", text.replace("**", "^"))
