"""Bodies, loads, elements and systems; their energy, momentum and power."""

from .body import Body, center_of_mass
from .constraint import Constraint
from .element.element import Element
from .element.line_force import line_force
from .element.spring import spring
from .energy import gravitational_energy, kinetic_energy, mechanical_energy, potential_energy
from .load import Action, Force, Load, Torque, power
from .momentum import angular_momentum, linear_momentum
from .show import describe, show
from .system import System
from .variables import Variables

__all__ = [
    "Action",
    "Body",
    "Constraint",
    "Element",
    "Force",
    "Load",
    "System",
    "Torque",
    "Variables",
    "angular_momentum",
    "center_of_mass",
    "describe",
    "gravitational_energy",
    "kinetic_energy",
    "line_force",
    "linear_momentum",
    "mechanical_energy",
    "potential_energy",
    "power",
    "show",
    "spring",
]
