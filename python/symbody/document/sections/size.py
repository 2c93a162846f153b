"""The size of the model: unknowns, and operations."""

from __future__ import annotations

from symbody.document.document import Block, Heading, Table
from symbody.document.subject import Subject
from symbody.symbolic import Cost, cost


def size(subject: Subject) -> list[Block]:
    """Return the section."""
    found = subject.equations
    counts = {
        "coordinates": len(found.coordinates),
        "speeds": len(found.speeds),
        "states": len(found.states),
        "constraints": len(found.constraints),
        "inputs": len(found.inputs),
        "parameters": len(found.parameters),
    }
    if not found.states:
        del counts["states"]
    costs = {"residuals": subject.cost}
    if not subject.is_large:
        costs |= {"mass matrix": cost(found.mass_matrix), "bias": cost(found.bias)}
    if found.constraints:
        costs["constraints"] = cost(found.constraints)
    numbers = Table(("size", "number"), tuple(((name,), (str(n),)) for name, n in counts.items()))
    header = ("operations", "additions", "multiplications", "divisions", "functions", "total")
    rows = tuple(((name,), *((str(n),) for n in _counts(each))) for name, each in costs.items())
    return [Heading("Size"), numbers, Table(header, rows)]


def _counts(found: Cost) -> tuple[int, ...]:
    four = found.additions, found.multiplications, found.divisions
    return (*four, found.total - sum(four), found.total)
