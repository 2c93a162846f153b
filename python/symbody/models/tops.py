"""Tops: a body on a fixed point, and a rotor in gimbals."""

from __future__ import annotations

from symbody.geometry import Vector, ground
from symbody.multibody import Link, assemble, motor, revolute, spherical
from symbody.symbolic import functions_of_time, symbols, time_derivative

from .classic_system import ClassicSystem


def heavy_top() -> ClassicSystem:
    """Return a heavy top on a fixed point, by the angles psi about the vertical z, theta about x, phi about its axis y.

    The numbers are those of the source.

    >>> from symbody import newton_euler
    >>> newton_euler(heavy_top().system)
    Equations(3 equations of motion, 0 constraints, coordinates psi, theta, phi)
    """
    m, g, l, Ix, Iy, Iz = symbols("m g l I_x I_y I_z")
    psi, _, phi = angles = functions_of_time("psi theta phi")
    top = Link("top", m, Ix, Iy, Iz, center=(0, l, 0))
    mechanism = assemble([spherical("O", ground, top, axes="ZXY", coordinates=angles)])
    return ClassicSystem(
        mechanism.system(gravity=Vector(ground, 0, 0, -g), name="Heavy top"),
        "Bruls, Cardona & Arnold, Lie group generalized-alpha time integration of constrained flexible multibody"
        " systems, Mechanism and Machine Theory 48 (2012), p. 121",
        {m: 15.0, g: 9.81, l: 1.0, Ix: 0.234375, Iy: 0.46875, Iz: 0.234375},
        {time_derivative(psi): -4.61538, time_derivative(phi): 150.0},
    )


def gyroscope_in_gimbals() -> ClassicSystem:
    """Return a rotor in two gimbals: the outer one turns about the vertical, the inner one about x, the rotor about z.

    The inputs M1, M2 and M3 are the torques of motors about the axes. The numbers are typical of a small gyroscope, and
    not from the source.

    >>> from symbody import newton_euler
    >>> newton_euler(gyroscope_in_gimbals().system).mass_matrix[0, 2]
    C*cos(theta)
    """
    A, C, A1, B1, C1, C2 = symbols("A C A1 B1 C1 C2")
    psi, theta, phi, M1, M2, M3 = functions_of_time("psi theta phi M1 M2 M3")
    outer, inner, rotor = (
        Link("outer gimbal", Iz=C2),
        Link("inner gimbal", 0, A1, B1, C1),
        Link("rotor", 0, A, A, C),
    )
    mechanism = assemble(
        [
            revolute("outer_axis", ground, outer, coordinate=psi),
            revolute("inner_axis", outer, inner, axis="X", coordinate=theta),
            revolute("rotor_axis", inner, rotor, coordinate=phi),
        ]
    )
    one, two, three = (mechanism.body(link) for link in (outer, inner, rotor))
    motors = [
        motor(psi, M1, on=one, name="motor 1"),
        motor(theta, M2, on=two, reaction=one, name="motor 2"),
        motor(phi, M3, on=three, reaction=two, name="motor 3"),
    ]
    return ClassicSystem(
        mechanism.system(motors, name="Gyroscope in gimbals"),
        "Magnus, Kreisel: Theorie und Anwendungen, Springer 1971",
        {A: 0.006, C: 0.01, A1: 0.002, B1: 0.003, C1: 0.002, C2: 0.004},
        {theta: 1.0, time_derivative(theta): 0.2, time_derivative(phi): 300.0},
        {M1: 0.0, M2: 0.0, M3: 0.0},
    )
