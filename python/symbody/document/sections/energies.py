"""The energies: kinetic, and potential of weight and loads."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.document.document import Block, Heading, prose
from symbody.document.formula import equalities
from symbody.document.subject import Subject
from symbody.multibody import System, kinetic_energy
from symbody.multibody.energy import gravitational_energy, known_potential, potentials
from symbody.symbolic import Expr, gradient, jacobian, number


def energies(subject: Subject) -> list[Block]:
    """Return the section; of equations that were given without bodies, the given energy."""
    system, given = subject.mechanism, subject.equations.energy
    if system is None:
        said = prose("The energy is")
        return [] if given is None else [Heading("Energies"), *equalities(said, ["E"], subject.read([given]))]
    found = {"T": kinetic_energy(system)}
    sentence = "The kinetic energy is"
    stored = known_potential(system)
    if stored is not None:
        found["V"] = stored
        of = "of weight and loads" if potentials(system.loads, system.bodies) else "of weight"
        sentence = f"The kinetic energy, and the potential energy {of}, are"
    names = [*found]
    values: list[Expr | Sequence[Expr]] = list(found.values())
    if not subject.is_large:
        (T,) = system.by_speeds([found.pop("T")])
        values = [_quadratic(T, system.speeds, subject), *(_by_cause(system, subject) for _ in found)]
    return [Heading("Energies"), *equalities(prose(sentence), names, values, system)]


def _by_cause(system: System, subject: Subject) -> Sequence[Expr]:
    """Return the potential energy as a sum: the weight of each body, and the energy of each load."""
    gravity = system.gravity if system.root.carrier is None else None
    weights = [] if gravity is None else [gravitational_energy([body], gravity) for body in system.bodies]
    loads = potentials(system.loads, system.bodies)
    terms = subject.read([each for each in (*_together(weights, subject), *loads) if not each.is_zero])
    return terms or [number(0)]


def _together(weights: Sequence[Expr], subject: Subject) -> Sequence[Expr]:
    """Return the energies of weights, or their sum if it is much shorter."""
    total = sum(weights, start=number(0))
    (short,), each = subject.read([total]), subject.read(weights)
    return [total] if len(str(short)) < _SHORT * sum(len(str(one)) for one in each) else weights


_SHORT = 0.8
"""The length of the energy of all weights, at most, in relation to that of each, where it is printed."""


def _quadratic(T: Expr, speeds: Sequence[Expr], subject: Subject) -> list[Expr]:
    """Return the terms of ``1/2 M_11 u_1^2 + M_12 u_1 u_2 + ...``, each coefficient for the reader, and what is left.

    Squares with one coefficient are one term: ``1/2 m (x'^2 + y'^2)``.
    """
    M = jacobian(gradient(T, speeds), speeds)
    n, products, squares = range(len(speeds)), list[tuple[Expr, Expr]](), set[Expr]()
    for i in n:
        if M[i, i] not in squares:
            squares.add(M[i, i])
            alike = (speeds[k] ** 2 for k in n if M[k, k] == M[i, i])
            products.append((M[i, i], sum(alike, start=number(0)) / 2))
        products += [(M[i, j], speeds[i] * speeds[j]) for j in n[i + 1 :]]
    rest = T - sum((coefficient * product for coefficient, product in products), start=number(0))
    *coefficients, rest = subject.read([*(coefficient for coefficient, _ in products), rest])
    terms = [coefficient * product for coefficient, (_, product) in zip(coefficients, products, strict=True)]
    return [term for term in (*terms, rest) if not term.is_zero] or [rest]
