"""Bodies, loads, elements and systems; their energy, momentum and power."""

from .body import Body, center_of_mass
from .combined import combined
from .constraint import Constraint
from .displaced import displaced
from .element.air_force import air_force
from .element.bushing import bushing
from .element.contact import contact
from .element.element import Element
from .element.friction import friction
from .element.line_force import line_force
from .element.linear_tire import linear_tire
from .element.magic_formula import magic_formula
from .element.motor import motor, saturated
from .element.spring import spring
from .element.tire import tire
from .element.tire_force import TireForce, TireLaw
from .element.tire_kinematics import TireKinematics, tire_kinematics
from .element.torsion_spring import torsion_spring
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
    "TireForce",
    "TireKinematics",
    "TireLaw",
    "Torque",
    "Variables",
    "air_force",
    "angular_momentum",
    "bushing",
    "center_of_mass",
    "combined",
    "contact",
    "describe",
    "displaced",
    "friction",
    "gravitational_energy",
    "kinetic_energy",
    "line_force",
    "linear_momentum",
    "linear_tire",
    "magic_formula",
    "mechanical_energy",
    "motor",
    "potential_energy",
    "power",
    "saturated",
    "show",
    "spring",
    "tire",
    "tire_kinematics",
    "torsion_spring",
]
