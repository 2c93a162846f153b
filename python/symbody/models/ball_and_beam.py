"""The ball and beam."""

from __future__ import annotations

from symbody.geometry import Vector, ground, rotate, translate
from symbody.multibody import Body, System, motor
from symbody.symbolic import functions_of_time, symbols

from .classic_system import ClassicSystem


def ball_and_beam() -> ClassicSystem:
    """Return a ball that rolls on a beam, which turns about its middle, level where theta is zero.

    The centre of the ball is on the axis of the beam, and its rolling adds no momentum about the pivot, as in the
    source: it spins by r/R about the beam. The input tau is the torque on the beam. The numbers are those of the
    source.

    >>> from symbody import newton_euler
    >>> newton_euler(ball_and_beam().system).bias[0]
    -M*(r*theta'**2 - G*sin(theta))
    """
    M, R, J, Jb, G = symbols("M R J Jb G")
    r, theta, tau = functions_of_time("r theta tau")
    beam = Body(rotate("Z", theta), 0, Iz=J, name="beam")
    ball = Body(beam.frame * translate(r, 0, 0) * rotate("X", r / R), M, Jb, Jb, Jb, name="ball")
    drive = motor(theta, tau, on=beam, name="motor")
    system = System([beam, ball], [drive], [r, theta], gravity=Vector(ground, 0, -G, 0), name="Ball and beam")
    return ClassicSystem(
        system,
        "Hauser, Sastry & Kokotovic, Nonlinear control via approximate input-output linearization: the ball and beam"
        " example, IEEE Trans. Automatic Control 37 (1992), p. 392",
        {M: 0.05, R: 0.01, J: 0.02, Jb: 2e-6, G: 9.81},
        {r: 0.1, theta: -0.05},
        {tau: 0.0},
    )
