"""Bodies, loads and systems; their energy, momentum and power."""

from .body import Body, center_of_mass
from .constraint import Constraint
from .energy import gravitational_energy, kinetic_energy, mechanical_energy
from .joint.assemble import assemble
from .joint.cylindrical import cylindrical
from .joint.fixed import fixed
from .joint.free import free
from .joint.gear import gear
from .joint.link import Link
from .joint.mechanism import Mechanism
from .joint.planar import planar
from .joint.point_on_curve import point_on_curve
from .joint.prismatic import prismatic
from .joint.rack import rack
from .joint.revolute import revolute
from .joint.rolling import rolling
from .joint.screw import screw
from .joint.spherical import spherical
from .joint.universal import universal
from .load import Action, Force, Load, Torque, power
from .momentum import angular_momentum, linear_momentum
from .show import describe, show
from .system import System
from .variables import Variables

__all__ = [
    "Action",
    "Body",
    "Constraint",
    "Force",
    "Link",
    "Load",
    "Mechanism",
    "System",
    "Torque",
    "Variables",
    "angular_momentum",
    "assemble",
    "center_of_mass",
    "cylindrical",
    "describe",
    "fixed",
    "free",
    "gear",
    "gravitational_energy",
    "kinetic_energy",
    "linear_momentum",
    "mechanical_energy",
    "planar",
    "point_on_curve",
    "power",
    "prismatic",
    "rack",
    "revolute",
    "rolling",
    "screw",
    "show",
    "spherical",
    "universal",
]
