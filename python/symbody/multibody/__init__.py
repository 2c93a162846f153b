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
from .element.tire_file import TireFile, tire_file
from .element.tire_force import TireForce, TireLaw
from .element.tire_kinematics import TireKinematics, tire_kinematics
from .element.tire_shape import TireShape, tire_shape
from .element.torsion_spring import torsion_spring
from .energy import gravitational_energy, kinetic_energy, mechanical_energy, potential_energy
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
from .resultant import Resultant, resultant
from .show import describe, show
from .system import System
from .variables import Variables

__all__ = [
    "Action",
    "Body",
    "Constraint",
    "Element",
    "Force",
    "Link",
    "Load",
    "Mechanism",
    "Resultant",
    "System",
    "TireFile",
    "TireForce",
    "TireKinematics",
    "TireLaw",
    "TireShape",
    "Torque",
    "Variables",
    "air_force",
    "angular_momentum",
    "assemble",
    "bushing",
    "center_of_mass",
    "combined",
    "contact",
    "cylindrical",
    "describe",
    "displaced",
    "fixed",
    "free",
    "friction",
    "gear",
    "gravitational_energy",
    "kinetic_energy",
    "line_force",
    "linear_momentum",
    "linear_tire",
    "magic_formula",
    "mechanical_energy",
    "motor",
    "planar",
    "point_on_curve",
    "potential_energy",
    "power",
    "prismatic",
    "rack",
    "resultant",
    "revolute",
    "rolling",
    "saturated",
    "screw",
    "show",
    "spherical",
    "spring",
    "tire",
    "tire_file",
    "tire_kinematics",
    "tire_shape",
    "torsion_spring",
    "universal",
]
