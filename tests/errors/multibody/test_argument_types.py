"""Arguments of another kind, for every argument of every joint, element and body: the whole message of each."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Any

import pytest

import symbody as sb
from symbody import SymbodyError, ground, symbols

x, psi, theta = sb.functions_of_time("x psi theta")
block = sb.Body(sb.translate(x, 0, 0), 1, name="block")
fork = sb.translate(x, 0, 1) * sb.rotate("Z", psi)
wheel = sb.Body(fork * sb.rotate("Y", theta), 1, 1, 1, 1, name="wheel")
crank, nut = sb.Link("crank", 1, Iz=1), sb.Link("nut", 1, Iz=1)
pin, hinge, slide = (
    sb.revolute("P", ground, crank),
    sb.revolute("Q", ground, nut, at=(3, 0, 0)),
    sb.prismatic("S", ground, nut, at=(0, -1, 0)),
)
k, high = symbols("k"), sb.Point(ground, 0, 1, 0)

EXPECTED = {
    "text": "a text",
    "flag": "a bool",
    "scalar": "an expression, such as symbols('a'), or a finite number",
    "part": "a link, such as Link('rod', mass), or a frame that carries the mechanism, such as ground",
    "place": "three coordinates, such as (a, 0, 0), or a frame, such as translate(a, 0, 0) * rotate('X', alpha)",
    "axis": "'X', 'Y' or 'Z'; for another axis, turn the places: at=rotate(...), to=rotate(...)",
    "axes": "a text of the letters X, Y and Z, such as 'ZYX'",
    "function": "a function of time, such as functions_of_time('phi')",
    "functions": "a list of functions of time, such as functions_of_time('psi theta phi')",
    "pair": "two values of the coordinate, such as (-1, 1), or None for no limit",
    "pairs": "a dictionary of pairs of values by the names of coordinates, such as {'phi': (-1, 1)}",
    "loop": "True, False or None",
    "curve": "a function from the parameter to three coordinates, such as lambda s: (s, a*s**2, 0)",
    "joint": "a joint, such as revolute('A', carrier, wheel)",
    "joints": "a list of joints, such as [revolute('A', ground, crank)]",
    "small": "a number, such as 1e-6, in m and as the sine of an angle",
    "center": "the centre of mass: a point, such as Point(frame, x, y, z), or a frame whose origin it is",
    "tensor": "a symmetric 3x3 matrix: three rows of three entries each",
    "point": "a point, such as Point(frame, x, y, z) or center_of_mass(body)",
    "frame": "a frame, such as ground or rotate('Z', angle)",
    "vector": "a vector, such as Vector(frame, x, y, z)",
    "body": "a body, such as Body(frame, mass)",
    "bodies": "a list of bodies, such as [wheel, tyre]",
    "freedom": "a coordinate of a joint, or a freedom of one, such as mechanism.joint('C').freedom()",
    "six": "six numbers, or a symmetric 6x6 matrix",
    "limit": "a positive number or an expression, the largest effort, (low, high), or None for no limit",
    "range": "a positive number or an expression, the largest effort, or (low, high)",
    "law": (
        "the law of a tyre, such as linear_tire(cornering=6e4), magic_formula(coefficients) or tire_file(path).law()"
    ),
    "coefficients": (
        "a dictionary of coefficients by the names of tyre property files, such as {'FNOMIN': 4000, 'PCY1': 1.3}"
    ),
    "version": "'5.2' or '6.1'",
    "radius": "the radius of the tyre, or its shape, such as tire_shape(y, z) returns",
    "lengths": "two lengths, such as (0.1, 0.3): longitudinal and lateral",
    "spin": 'the spin axis "Y" or "-Y" of the wheel, which points to the left',
    "path": "the path of a tyre property file, such as 'front.tir'",
    "moving": "equations of motion, such as newton_euler(system), or a system in which nothing moves",
    "cut": "a joint, a body, a link, the name of one, or a list of bodies that are cut off together",
    "side": "one of the two parts that the joint connects",
}

JOINED = {"name": "J", "parent": ground, "child": crank}
JOINS = "name=text parent=part child=part at=place to=place"
ONE, SEVERAL = "coordinate=function limits=pair loop=loop", "coordinates=functions limits=pairs loop=loop"
INERTIA = " ".join(f"{name}=scalar" for name in ("mass", "Ix", "Iy", "Iz", "Cyz", "Cxz", "Cxy"))
ON, REACTS = "on=body name=text", "on=body reaction=body name=text"
ROLLS = "wheel=body radius=radius crown_radius=scalar rolling_radius=scalar road=frame carrier=frame spin_axis=spin"
ROLLING = {"wheel": wheel, "radius": 1}
SHAPE = ("y", "z", "spin_deformation", "y_deformation", "z_deformation")

Row = tuple[Callable[..., object], Mapping[str, object], str, str]

ROWS: list[Row] = [
    (sb.revolute, JOINED, "revolute J", f"{JOINS} axis=axis {ONE}"),
    (sb.prismatic, JOINED, "prismatic J", f"{JOINS} axis=axis {ONE}"),
    (sb.screw, JOINED | {"pitch": 1}, "screw J", f"{JOINS} pitch=scalar axis=axis {ONE}"),
    (sb.cylindrical, JOINED, "cylindrical J", f"{JOINS} axis=axis {SEVERAL}"),
    (sb.planar, JOINED, "planar J", f"{JOINS} axis=axis {SEVERAL}"),
    (sb.universal, JOINED, "universal J", f"{JOINS} axes=axes {SEVERAL}"),
    (sb.spherical, JOINED, "spherical J", f"{JOINS} axes=axes quaternion=flag {SEVERAL}"),
    (sb.fixed, JOINED, "fixed J", f"{JOINS} loop=loop"),
    (sb.free, JOINED, "free J", f"{JOINS} axes=axes coordinates=functions limits=pairs quaternion=flag"),
    (sb.rolling, JOINED | {"radius": 1}, "rolling J", f"{JOINS} radius=scalar crown=scalar {SEVERAL}"),
    (
        sb.point_on_curve,
        JOINED | {"curve": lambda s: (s, 0, 0)},
        "point_on_curve J",
        f"{JOINS} curve=curve axes=axes {SEVERAL}",
    ),
    (
        sb.gear,
        {"name": "G", "first": pin, "second": hinge, "radius1": 1, "radius2": 2},
        "gear G",
        "name=text first=joint second=joint radius1=scalar radius2=scalar internal=flag",
    ),
    (
        sb.rack,
        {"name": "K", "pinion": pin, "bar": slide, "radius": 1},
        "rack K",
        "name=text pinion=joint bar=joint radius=scalar",
    ),
    (sb.assemble, {"joints": [pin]}, "assemble", "joints=joints tolerance=small"),
    (sb.Link, {"name": "L"}, "Link L", f"name=text {INERTIA} center=place"),
    (
        sb.Link.of_inertia,
        {"name": "L", "mass": 1, "inertia": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]},
        "Link.of_inertia",
        "name=text mass=scalar inertia=tensor center=place about=place",
    ),
    (sb.Body, {"place": ground, "mass": 1}, "Body", f"place=center {INERTIA} name=text"),
    (
        sb.Body.of_inertia,
        {"place": ground, "mass": 1, "inertia": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]},
        "Body.of_inertia",
        "place=center mass=scalar inertia=tensor about=point name=text",
    ),
    (sb.combined, {"bodies": [block]}, "combined", "bodies=bodies frame=frame name=text"),
    (
        sb.Force,
        {"what": sb.Vector(ground, 1, 0, 0), "at": high, "on": block},
        "Force",
        f"at=point {REACTS}",
    ),
    (sb.Torque, {"what": sb.Vector(ground, 1, 0, 0), "on": block}, "Torque", REACTS),
    (
        sb.spring,
        {"at": block.center_of_mass, "to": high, "stiffness": k, "on": block},
        "spring",
        f"at=point to=point stiffness=scalar free_length=scalar damping=scalar {REACTS}",
    ),
    (
        sb.torsion_spring,
        {"angle": x, "stiffness": k, "on": block},
        "torsion_spring",
        f"angle=freedom stiffness=scalar free_angle=scalar damping=scalar all_turns=flag {REACTS}",
    ),
    (
        sb.bushing,
        {"frame": block.frame, "to": ground, "stiffness": [k] * 6, "on": block},
        "bushing",
        f"frame=frame to=frame stiffness=six damping=six {REACTS}",
    ),
    (
        sb.motor,
        {"coordinate": x, "effort": k, "on": block},
        "motor",
        f"coordinate=freedom effort=scalar limit=limit {REACTS}",
    ),
    (
        sb.friction,
        {"coordinate": x, "viscous": k, "on": block},
        "friction",
        "coordinate=freedom viscous=scalar coulomb=scalar static=scalar stribeck_speed=scalar creep_speed=scalar "
        + REACTS,
    ),
    (
        sb.line_force,
        {"force": k, "at": block.center_of_mass, "to": high, "on": block},
        "line_force",
        f"force=scalar at=point to=point {REACTS}",
    ),
    (
        sb.air_force,
        {"at": block.center_of_mass, "density": k, "drag_area": 1, "on": block},
        "air_force",
        f"at=point density=scalar drag_area=scalar lift_area=scalar span=vector wind=vector {ON}",
    ),
    (
        sb.contact,
        {"center": block.center_of_mass, "radius": k, "stiffness": 1, "on": block},
        "contact",
        (
            "center=point radius=scalar stiffness=scalar plane=frame exponent=scalar damping=scalar friction=scalar "
            f"creep_speed=scalar {REACTS}"
        ),
    ),
    (
        sb.linear_tire,
        {"cornering": k},
        "linear_tire",
        "longitudinal=scalar cornering=scalar camber=scalar trail=scalar per_load=flag",
    ),
    (
        sb.magic_formula,
        {"coefficients": {"FNOMIN": 4000}},
        "magic_formula",
        "coefficients=coefficients version=version pressure=scalar",
    ),
    (
        sb.tire,
        ROLLING | {"law": sb.linear_tire(cornering=k), "load": 1},
        "tire",
        (
            f"{ROLLS} law=law load=scalar load_acts=flag stiffness=scalar damping=scalar relaxation=lengths "
            "least_speed=scalar reaction=body name=text"
        ),
    ),
    (sb.tire_kinematics, ROLLING, "tire_kinematics", ROLLS),
    (sb.tire_shape, {"y": 0, "z": 1}, "tire_shape", " ".join(f"{each}=scalar" for each in SHAPE)),
    (sb.tire_file, {"path": "front.tir"}, "tire_file", "path=path"),
    (sb.saturated, {"effort": 1, "limit": 2}, "saturated", "effort=scalar limit=range"),
    (
        sb.reaction,
        {"equations": sb.newton_euler(sb.assemble([pin]).system()), "cut": "P"},
        "reaction",
        "equations=moving cut=cut on=side about=point frame=frame",
    ),
]


@pytest.mark.parametrize(
    ("make", "given", "where", "kinds"), ROWS, ids=lambda each: getattr(each, "__name__", "")
)
def test_an_argument_of_another_kind_is_named_with_what_was_expected(
    make: Callable[..., Any], given: Mapping[str, object], where: str, kinds: str
) -> None:
    arguments = dict(each.split("=") for each in kinds.split())
    positional = {"what": given["what"]} if "what" in given else {}
    assert {*arguments} | {*positional} == {*inspect.signature(make).parameters} - {"components"}
    named = {name: value for name, value in given.items() if name not in positional}
    for name, kind in arguments.items():
        place = where.split(maxsplit=1)[0] if name == "name" else where
        with pytest.raises(SymbodyError) as caught:
            make(*positional.values(), **named | {name: 1j})
        assert str(caught.value) == f"{place}: {name} = 1j is a complex; expected {EXPECTED[kind]}"
