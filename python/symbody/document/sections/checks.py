"""Checks: laws that hold by value, proved for this model."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from symbody.document.document import Block, Heading, Math, Table, Words, prose
from symbody.document.subject import Subject
from symbody.dynamics import Equations, lagrange_equations, newton_euler
from symbody.errors import SymbodyError
from symbody.multibody import gravitational_energy, kinetic_energy, power
from symbody.simulation.model.drive import moves_at_rest
from symbody.symbolic import Expr, derivation, latex, number, readable, substitute, t
from symbody.symbolic.expression.latex_layout import LINE, width

HOLDS, FAILS = "proved", "does not hold"


def checks(subject: Subject) -> list[Block]:
    """Return the section."""
    if subject.is_large:
        return [Heading("Checks"), prose("The equations are too large for checks within a report.")]
    found = ((law, outcome(subject)) for law, outcome in LAWS.items())
    rows = tuple((_said(law, subject), (result,)) for law, result in found if result is not None)
    said = "Expressions are compared by value, not by form."
    return [Heading("Checks"), prose(said), Table(("law", "result"), rows)]


def _said(law: str, subject: Subject) -> Words:
    """Return a law in words, that of power with the power of constraints that move."""
    if law != POWER or subject.mechanism is None:
        return (law,)
    given = _power_of_constraints(subject.equations)
    if given.is_zero:
        return (law,)
    shown = latex(readable(given))
    named: Words = (", ", Math(shown), ",") if width(shown) <= LINE else ()
    return ("the power of the loads and of the constraints that move", *named, " is the rate of the energy")


def _formalisms_agree(subject: Subject) -> str | None:
    system = subject.mechanism
    if system is None:
        return None
    whole = system.whole
    try:
        both = newton_euler(whole).residuals == lagrange_equations(whole).residuals
    except SymbodyError as error:
        return f"does not apply ({str(error).partition(':')[0]} does not derive this system)"
    return HOLDS if both else FAILS


def _is_symmetric(subject: Subject) -> str:
    mass = subject.equations.mass_matrix
    if mass == mass.T:
        return HOLDS
    return FAILS if subject.mechanism is None else f"{FAILS}: loads depend on accelerations"


def _power_balances(subject: Subject) -> str | None:
    """Compare ``u . R + lambda . (A u + b)`` with ``T' + V' - P``: both are zero along a motion.

    R are the residuals, ``A u + b`` the rates of the constraints; P is the power of the loads, and that of the
    constraints, ``-lambda . b``, which only those have that move by themselves.
    """
    found, system = subject.equations, subject.mechanism
    if system is None:
        return None
    with derivation():
        energy = kinetic_energy(system)
        if system.gravity is not None:
            if system.root.carrier is not None:
                return "does not apply (the root frame moves)"
            energy += gravitational_energy(system)
        unknown = {each.name for each in (*system.coordinates, *system.quasi_velocities)}
        given = {each.name for each in energy.free_symbols if each.depends_on_time} - unknown
        if given or t in energy.free_symbols:
            return "does not apply (frames move as given functions of time)"
        if moves_at_rest(system, system.speeds, system.by_speeds):
            return "does not apply (the system moves while all speeds are zero)"
        (rate,) = system.rate([energy])
        spent = sum((power(load) for load in system.loads), start=number(0))
        (gained,) = system.by_speeds([rate - spent - _power_of_constraints(found)])
        left = _dot(_along(found), found.residuals)
        if found.constraints:
            left += _dot(found.multipliers, system.velocity_level(found.constraints))
    return HOLDS if left == gained else FAILS


def _power_of_constraints(found: Equations) -> Expr:
    """Return ``-lambda . b`` of constraints ``A u + b = 0``, such as ``-lambda . phi_t`` of those on positions."""
    if not found.constraints:
        return number(0)
    rates = found.system.velocity_level(found.constraints)
    return -_dot(found.multipliers, substitute(rates, dict.fromkeys(found.speeds, number(0))))


def _along(found: Equations) -> Sequence[Expr]:
    """Return what the residuals are multiplied by: the speeds, also those that momenta replaced without constraints."""
    system = found.system
    return tuple(system.eliminated.values()) if system.momenta and not found.constraints else found.speeds


def _dot(first: Sequence[Expr], second: Sequence[Expr]) -> Expr:
    return sum((a * b for a, b in zip(first, second, strict=True)), start=number(0))


POWER = "the power of the loads is the rate of the energy"
LAWS: dict[str, Callable[[Subject], str | None]] = {
    "newton_euler and lagrange_equations give the same equations": _formalisms_agree,
    "the mass matrix is symmetric": _is_symmetric,
    POWER: _power_balances,
}
"""The laws, each with the function that checks it; None without the bodies of which it speaks."""
