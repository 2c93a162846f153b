"""The same mechanisms modelled in four ways: the operations of the equations should not depend on the way."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from symbody import Expr, System, newton_euler
from tests.dynamics.ways_of_modelling import MECHANISMS, WAYS, Mechanism, modelled

from .by_symbody.formalism import mass_matrix_and_bias, residuals
from .engines import SYMBODY

STATEMENT = """\
## The same mechanism, modelled in four ways

Each mechanism has the same coordinates in all ways. *Chain*: the frame of each link is built on that of its carrier,
`frame * translate(joint) * rotate("Z", q[i] - q[i - 1])`. *Turned back*: frames parallel to ground from joint to joint;
each rotation is turned back behind the displacement. *Offsets of points*: the frame of each link is placed at its joint
as a point of the ground; centres of mass are points of these frames. *Points of ground*: each centre of mass is a point
of the ground, with a frame only where there is inertia. Operations of mass matrix (upper triangle) and bias, and of the
residuals, by newton_euler; *most / fewest* is the ratio over the ways.
"""


def ways() -> str:
    """Return the tables of operations by mechanism and way."""
    tables = (
        "\n".join([*_header(title), *_rows(lambda system, find=find: find(newton_euler, system)), ""])
        for title, find in (("mass matrix and bias", mass_matrix_and_bias), ("residuals", residuals))
    )
    return "\n".join([STATEMENT, *tables])


def _header(title: str) -> Iterator[str]:
    yield f"| {title} | {' | '.join(WAYS)} | most / fewest |"
    yield "|---|" + "---:|" * (len(WAYS) + 1)


def _rows(derive: Callable[[System], Sequence[Expr]]) -> Iterator[str]:
    for name, mechanism in MECHANISMS.items():
        counts = [_operations(derive, mechanism, way) for way in WAYS]
        cells = [name, *(f"{count:,}".replace(",", " ") for count in counts)]
        yield f"| {' | '.join(cells)} | {max(counts) / min(counts):.2f} |"


def _operations(derive: Callable[[System], Sequence[Expr]], mechanism: Mechanism, way: str) -> int:
    return SYMBODY.lower(SYMBODY.compress(derive(modelled(mechanism, way)))).count().total
