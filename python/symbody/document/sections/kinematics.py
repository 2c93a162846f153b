"""The kinematics: degrees of freedom, constraints, rates of coordinates, and the centres of mass."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.document.document import Block, Heading, prose
from symbody.document.formula import equalities, listed
from symbody.document.subject import Subject
from symbody.dynamics.display.page import shorter
from symbody.dynamics.display.reader_of import reader_of
from symbody.symbolic import Expr, latex
from symbody.symbolic.given.arguments import counted


def kinematics(subject: Subject) -> list[Block]:
    """Return the section."""
    system = subject.system
    blocks: list[Block] = [
        Heading("Kinematics"),
        prose(f"{_are('coordinate', system.coordinates)} ", *listed(system.coordinates), ".")
        if system.coordinates
        else prose(),
    ]
    if system.quasi_velocities:
        kind = "momenta" if system.momenta else "quasi-velocities"
        blocks.append(prose(f"The {kind} are ", *listed(system.quasi_velocities), "."))
    blocks.append(prose(_freedom(subject)))
    rates = {
        rate: by_speeds for rate, by_speeds in system.known_rates.items() if rate not in system.state_rates
    }
    if rates:
        lead = prose(f"The rates of the coordinates, by the {'momenta' if system.momenta else 'speeds'}, are")
        values = [*rates.values()]
        if system.eliminated:  # these rates are as long as the solution of the constraints
            values = _shortest(values, subject)
        blocks += equalities(lead, [*map(latex, rates)], values, system if system.eliminated else None)
    if system.constraints:
        one = len(system.constraints) == 1
        start = "The constraint, whose multiplier is " if one else "The constraints, whose multipliers are "
        lead = prose(start, *listed(system.multipliers), ", is" if one else ", are")
        blocks += equalities(
            lead, ["0"] * len(system.constraints), _shortest(system.constraints, subject), system
        )
    if kept := system.eliminated_constraints:
        lead = prose("The constraints on positions, which the equations satisfy, are")
        blocks += equalities(lead, ["0"] * len(kept), _shortest(kept, subject), system)
    blocks += _centres(subject)
    return blocks


def _are(kind: str, items: Sequence[Expr]) -> str:
    return f"The {kind} is" if len(items) == 1 else f"The {kind}s are"


def _shortest(expressions: Sequence[Expr], subject: Subject) -> list[Expr]:
    """Return expressions in their shortest forms; those of a large system stay unchanged."""
    reader = reader_of(subject.system)
    return [each if subject.is_large else shorter(each, reader) for each in expressions]


def _freedom(subject: Subject) -> str:
    n, m = len(subject.equations.speeds), len(subject.equations.constraints)
    if m == 0:
        return f"The system has {counted(n, 'degree')} of freedom."
    return (
        f"The {counted(n, 'speed')} and {counted(m, 'constraint')} leave {counted(n - m, 'degree')} of freedom, "
        "if the constraints are independent."
    )


def _centres(subject: Subject) -> list[Block]:
    """Return the coordinates of the centres of mass, without those that are zero."""
    if subject.mechanism is None:
        return []
    places = {}
    for number, body in enumerate(subject.mechanism.bodies, start=1):
        for axis, value in zip("xyz", body.frame.pose.origin, strict=True):
            if not value.is_zero:
                places[rf"{axis}_{{\mathrm{{G}}{number}}}"] = value
    lead = "The centres of mass, in the axes of the root frame, are at"
    return (
        equalities(prose(lead), [*places], subject.read([*places.values()]), subject.system)
        if places
        else [prose(f"{lead} the origin.")]
    )
