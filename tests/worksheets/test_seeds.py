"""The two worksheets of users run as they are, and give what Maple printed.

Their texts are other people's, and not in the repository: they stand in a folder ``shared/seeds`` beside it. Where that
is missing, the tests say that they were skipped; on CI they are required.
"""

from __future__ import annotations

import os
import time
from functools import cache
from pathlib import Path

import pytest

from symbody.symbolic import Expr
from symbody.worksheet.check import verdict, verdicts
from symbody.worksheet.check.align import aligned
from symbody.worksheet.check.printed import functions_in, printed, value_of
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading import read_source
from symbody.worksheet.run import outcomes
from symbody.worksheet.sheet.outcome import Outcome
from symbody.worksheet.sheet.source import Cell
from symbody.worksheet.values.value import Listed, Relation, Sequence, Unevaluated, Value
from tests.worksheets.printed import assert_values

NEWTON, TRIFILAR = "000_ea6b06c18f5e54f8", "001_44942c621e52e3cb"
FOLDERS = [
    each / "shared" / "seeds" for each in Path(__file__).parents if (each / "shared" / "seeds").is_dir()
]


@cache
def ran(seed: str) -> tuple[tuple[Cell, ...], tuple[Outcome, ...], float]:
    """Return the cells of a seed, what became of its statements, and the seconds that this took."""
    if not FOLDERS:
        if "CI" in os.environ:
            pytest.fail("the folder shared/seeds is missing")
        pytest.skip("the seeds are other people's texts, and not in the repository")
    cells = read_source(FOLDERS[0] / f"{seed}.txt")
    begin = time.process_time()
    found = tuple(outcomes(cells, Interpreter()))
    return cells, found, time.process_time() - begin


@pytest.mark.parametrize("seed", [NEWTON, TRIFILAR])
def test_every_statement_runs_in_little_time(seed: str) -> None:
    _, found, seconds = ran(seed)
    assert [outcome.error for outcome in found if outcome.error] == []
    assert seconds < 2


def test_a_function_that_nobody_knows_comes_back() -> None:
    _, found, _ = ran(NEWTON)
    (outcome,) = [outcome for outcome in found if outcome.notices]
    assert outcome.notices == ("gravity_energy is not a command; did you mean gravitational_energy?",)
    assert outcome.printed[0].endswith("-gravity_energy(body1)")


@pytest.mark.parametrize(("seed", "compared"), [(NEWTON, 27), (TRIFILAR, 18)])
def test_nothing_differs_from_what_maple_printed(seed: str, compared: int) -> None:
    cells, found, _ = ran(seed)
    judged = verdicts(cells, found)
    assert [verdict for verdict in judged if verdict.kind == "differs"] == []
    assert sum(verdict.kind == "equal" for verdict in judged) == compared
    reasons = {
        verdict.reason.partition(", which")[0] for verdict in judged if verdict.kind == "not comparable"
    }
    assert reasons <= {"cut before anything complete", "a count of operations"}


@pytest.mark.parametrize("seed", [NEWTON, TRIFILAR])
def test_complete_results_are_no_longer_than_those_of_maple(seed: str) -> None:
    """Of an output that was cut, nobody knows the length."""
    cells, found, _ = ran(seed)
    blocks = [
        block
        for block in verdict._blocks(cells)
        if not verdict.is_picture(block.text) and "..." not in block.text
    ]
    partners = aligned(blocks, list(verdict._outputs(found)))
    pairs = [
        (block.text, ours.text) for block, ours in zip(blocks, partners, strict=True) if ours is not None
    ]
    assert len(pairs) >= 12
    assert [ours for maple, ours in pairs if _length(ours) > _length(maple) and _is_same(maple, ours)] == []


def _length(text: str) -> int:
    return len("".join(text.split()))


def _is_same(maple: str, ours: str) -> bool:
    """Whether outputs are the same result: sets have another order."""
    heads = [text.partition("=")[0].strip() for text in (maple, ours)]
    return heads[0] == heads[1] and not maple.lstrip()[0].isdigit()


#: For each result that was printed in full: the sheet, the beginning of what symbody prints, how many of those to pass
#: over, the field in which the numbers are, and the functions of time.
RESULTS = [
    ("TM", NEWTON, "TM := ", 0, "", "x z mu psi"),
    ("gravitational_energy", NEWTON, "-g*m*", 0, "", "z mu psi"),
    ("typo_check", NEWTON, "-g*m*", 1, "", "z mu psi"),
    ("TF", NEWTON, "TF := ", 0, "", "phi"),
    ("_gravity", NEWTON, "_gravity = ", 0, "comps", ""),
    ("Fext", NEWTON, "Fext = ", 0, "comps", ""),
    ("body2", NEWTON, "body2 = ", 0, "inertia", ""),
    ("project_F12", NEWTON, "FORCE(", 0, "comps", "phi"),
    ("M_torque", NEWTON, "M = ", 0, "comps", ""),
    ("MF", NEWTON, "MF := ", 0, "", "x y z"),
    ("AM_point_mass", NEWTON, "AM = ", 0, "comps", "x y z"),
    ("plate_side_lengths", TRIFILAR, "l^2, ", 0, "", ""),
    ("ground_side_lengths", TRIFILAR, "l^2, ", 1, "", ""),
    ("c1", TRIFILAR, "c1 := ", 0, "", "xA yA zA"),
]


@pytest.mark.parametrize(
    ("name", "seed", "begin", "skip", "field", "functions"), RESULTS, ids=[r[0] for r in RESULTS]
)
def test_complete_results(name: str, seed: str, begin: str, skip: int, field: str, functions: str) -> None:
    texts = [text for outcome in ran(seed)[1] for text in outcome.printed if text.startswith(begin)]
    assert_values(name, scalars(value(texts[skip]), field), functions)


def test_the_fourth_constraint() -> None:
    texts = [text.partition(", ")[2] for text in texts_of(TRIFILAR) if text[1:3] == ", "]
    assert_values(
        "constraint4", scalars(value(texts[texts.index("wx(t)^2+wy(t)^2+wz(t)^2-1")]), ""), "wx wy wz"
    )


def test_counts_and_multipliers() -> None:
    texts = texts_of(TRIFILAR)
    assert "nq := 12" in texts
    assert "21" in texts
    multipliers = value(next(text for text in texts if text.startswith("SL := ")))
    assert isinstance(multipliers, Listed)
    assert multipliers.items[0] == value("lambda1(t) = gamma1(t)+tau*diff(gamma1(t),t)")


def test_operations_are_not_more_than_maples() -> None:
    *_, cost = texts_of(TRIFILAR)
    count = {name: int(number) for number, _, name in (term.partition("*") for term in cost.split("+"))}
    assert list(count)[:3] == ["multiplications", "additions", "subscripts"]
    assert all(
        count[name] <= most
        for name, most in [
            ("multiplications", 276),
            ("additions", 110),
            ("subscripts", 135),
            ("divisions", 9),
        ]
    )


def texts_of(seed: str) -> list[str]:
    return [text for outcome in ran(seed)[1] for text in outcome.printed]


def value(text: str) -> Value:
    read = printed(text)
    return value_of(read.expression, functions_in(read.expression))


def scalars(found: Value, field: str) -> list[Expr]:
    """Return the scalars in a value, row by row, or in one field of an object."""
    match found:
        case Relation(left=Expr(), right=Unevaluated() as shown):
            return scalars(shown, field)
        case Unevaluated(arguments=fields):
            (content,) = [
                each.right for each in fields if isinstance(each, Relation) and str(each.left) == field
            ]
            return scalars(content, "")
        case Listed(items=items) | Sequence(items=items):
            return [scalar for item in items for scalar in scalars(item, field)]
    assert isinstance(found, Expr)
    return [found]
