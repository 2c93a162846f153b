"""Forces of the ground on wheels that close loops, of which one slip follows from others: at any heading."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

import symbody as sb

pytestmark = pytest.mark.filterwarnings("ignore::symbody.ModelNotice")

D = sb.time_derivative


def test_two_wheels_of_an_axle_carry_what_turns_the_cart() -> None:
    """The cart turns twice: forces across add up to mass times acceleration, and none is larger than that."""
    body, mass, h = sb.Link("body", 10, 1, 1, 2), 12, 0.5
    left, right = (sb.Link(name, 1, 0.02, 0.04, 0.02) for name in ("left", "right"))
    plane = sb.planar("P", sb.ground, body, at=(0, 0, 0.3))
    hubs = [
        sb.revolute(f"hub_{name}", body, wheel, at=(0, y, 0), axis="Y", coordinate=sb.functions_of_time(name))
        for wheel, y, name in ((left, h, "a"), (right, -h, "b"))
    ]
    grounds = [
        sb.rolling(f"on_{wheel.name}", sb.ground, wheel, radius=0.3, loop=True) for wheel in (left, right)
    ]
    made = sb.assemble([plane, *hubs, *grounds])
    motors = [
        sb.motor(hub.coordinate, torque, on=made.body(wheel), reaction=made.body(body))
        for hub, torque, wheel in zip(hubs, (1, 2), (left, right), strict=True)
    ]
    equations = sb.newton_euler(made.system(motors))
    heading = plane.coordinates[2]
    start = {heading: 0.2, D(hubs[0].coordinate): 2.0, D(hubs[1].coordinate): 3.0}
    motion = sb.simulate(equations, {}, start, t=np.linspace(0, 6, 301))
    assert np.ptp(motion[heading]) > 4 * np.pi / 2
    axes = made.frame(body)
    forces = [motion.evaluate(sb.reaction(equations, each, frame=axes).force.components) for each in grounds]
    needed = mass * motion.evaluate(
        sb.acceleration(made.body(body).center_of_mass).projected(axes).components
    )
    assert_allclose(sum(forces)[:2], needed[:2], atol=1e-6 * np.abs(needed).max())
    assert max(np.abs(force[1]).max() for force in forces) <= 1.001 * np.abs(needed[1]).max()


@pytest.mark.parametrize("start", [0.0, 0.3, 3.0])
def test_a_roller_on_an_arm_is_driven_by_what_spins_it(start: float) -> None:
    """``F r = J phi''``, wherever the arm points."""
    arm, roller, r, J = sb.Link("arm", 1, 0.02, 0.025, 0.03), sb.Link("roller", 20, 0.2, 0.4, 0.2), 0.3, 0.4
    post = sb.revolute("post", sb.ground, arm, at=(0, 0, r))
    hub = sb.revolute("hub", arm, roller, at=sb.translate(0.8, 0, 0) * sb.rotate("Z", sb.pi / 2), axis="Y")
    on_ground = sb.rolling("R", sb.ground, roller, radius=r, loop=True)
    made = sb.assemble([post, hub, on_ground])
    drive = sb.motor(post.coordinate, 30, on=made.body(arm))
    equations = sb.newton_euler(made.system([drive]))
    motion = sb.simulate(
        equations, {}, {post.coordinate: start, D(post.coordinate): 1.0}, t=np.linspace(0, 2, 51)
    )
    with pytest.warns(sb.ModelNotice, match="R, post and hub share them by minimum norm"):
        force = motion.evaluate(sb.reaction(equations, on_ground, frame=made.frame(arm)).force.components)
    spin = motion.evaluate([D(hub.coordinate, 2)])[0]
    assert_allclose(np.abs(force[1]), np.abs(J * spin / r), rtol=1e-6)
    assert_allclose(force[1], force[1, 0], rtol=1e-5)
