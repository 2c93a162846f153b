"""The energies: kinetic, and potential of weight and loads."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.document.document import Block, Heading, prose
from symbody.document.formula import equalities
from symbody.document.subject import Subject
from symbody.multibody import System, kinetic_energy
from symbody.multibody.energy import gravitational_energy, known_potential, potentials
from symbody.symbolic import Expr, cost, number
from symbody.symbolic.calculus.energy_form import quadratic_terms


def energies(subject: Subject) -> list[Block]:
    """Return the section; of equations that were given without bodies, the given energy."""
    system, given = subject.mechanism, subject.equations.energy
    if system is None:
        said = prose("The energy is")
        letters = _letters(subject, ("E",), (r"E_{\mathrm{tot}}",))
        return (
            [] if given is None else [Heading("Energies"), *equalities(said, letters, subject.read([given]))]
        )
    letters = _letters(subject, ("T", "V"), (r"E_{\mathrm{kin}}", r"E_{\mathrm{pot}}"))
    (T,), V = system.by_speeds([kinetic_energy(system)]), known_potential(system)
    potential = "potential energy of weight"
    if potentials(system.loads, system.bodies):
        potential += " and loads"
    if subject.is_large:
        blocks = equalities(prose("The kinetic energy is"), letters[:1], [T], system)
        if V is not None:
            terms = _by_cause(system, subject) if cost(V).total <= _MOST else [V]
            blocks += equalities(prose(f"The {potential} is"), letters[1:], [terms], system)
        return [Heading("Energies"), *blocks]
    values, sentence = [quadratic_terms(T, system.speeds, subject.read)], "The kinetic energy is"
    if V is not None:
        values.append(_by_cause(system, subject))
        sentence = f"The kinetic energy, and the {potential}, are"
    return [Heading("Energies"), *equalities(prose(sentence), letters[: len(values)], values, system)]


def _letters(subject: Subject, usual: Sequence[str], others: Sequence[str]) -> Sequence[str]:
    """Return the letters of energies: others if a name of the model is one of the usual, such as a torque T."""
    taken = {leaf.name for leaf in subject.system.leaves}
    return usual if taken.isdisjoint(usual) else others


_MOST = 300
"""Operations of the potential energy of a large system up to which it is read."""


def _by_cause(system: System, subject: Subject) -> list[Expr]:
    """Return the potential energy as a sum: the weight of each body, and the energy of each load."""
    gravity = system.gravity if system.root.carrier is None else None
    weights = [] if gravity is None else [gravitational_energy([body], gravity) for body in system.bodies]
    loads = potentials(system.loads, system.bodies)
    terms = subject.read([each for each in (*_together(weights, subject), *loads) if not each.is_zero])
    return [*terms] or [number(0)]


def _together(weights: Sequence[Expr], subject: Subject) -> Sequence[Expr]:
    """Return the energies of weights, or their sum if it is much shorter."""
    total = sum(weights, start=number(0))
    (short,), each = subject.read([total]), subject.read(weights)
    return [total] if len(str(short)) < _SHORT * sum(len(str(one)) for one in each) else weights


_SHORT = 0.8
"""The length of the energy of all weights, at most, in relation to that of each, where it is printed."""
