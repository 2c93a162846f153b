"""The energies: kinetic, and potential of weight."""

from __future__ import annotations

from symbody.document.document import Block, Heading, prose
from symbody.document.formula import equalities
from symbody.document.subject import Subject
from symbody.multibody import gravitational_energy, kinetic_energy
from symbody.symbolic import simplify


def energies(subject: Subject) -> list[Block]:
    """Return the section; of equations that were given without bodies, the given energy."""
    system, given = subject.mechanism, subject.equations.energy
    if system is None:
        said = prose("The energy is")
        return [] if given is None else [Heading("Energies"), *equalities(said, ["E"], subject.read([given]))]
    found = {"T": kinetic_energy(system)}
    sentence = "The kinetic energy is"
    if system.gravity is not None and system.root.carrier is None:
        found["V"] = gravitational_energy(system)
        sentence = "The kinetic energy, and the potential energy of weight, are"
    values = list(found.values()) if subject.is_large else simplify(list(found.values()))
    return [Heading("Energies"), *equalities(prose(sentence), [*found], values)]
