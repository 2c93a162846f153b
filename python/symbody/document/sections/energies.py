"""The energies: kinetic, and potential of weight and loads."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.document.document import Block, Heading, prose
from symbody.document.formula import equalities
from symbody.document.subject import Subject
from symbody.multibody import kinetic_energy
from symbody.multibody.energy import known_potential, potentials
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
    values = list(found.values())
    if not subject.is_large:
        (T,) = system.by_speeds(values[:1])
        values = [_quadratic(T, system.speeds, subject), *subject.read(values[1:])]
    return [Heading("Energies"), *equalities(prose(sentence), [*found], values, system)]


def _quadratic(T: Expr, speeds: Sequence[Expr], subject: Subject) -> Expr:
    """Return ``1/2 M_11 u_1^2 + M_12 u_1 u_2 + ...`` with each coefficient for the reader, and what is left."""
    M = jacobian(gradient(T, speeds), speeds)
    half, n = number(1) / 2, range(len(speeds))
    places = [(i, j) for i in n for j in n[i:]]
    products = [speeds[i] * speeds[j] * (half if i == j else 1) for i, j in places]
    rest = T - sum((M[p] * product for p, product in zip(places, products, strict=True)), start=number(0))
    *coefficients, rest = subject.read([*(M[p] for p in places), rest])
    return sum((c * product for c, product in zip(coefficients, products, strict=True)), start=rest)
