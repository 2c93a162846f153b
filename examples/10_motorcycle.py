"""A motorcycle at all speeds: its linear model in symbols, weave, wobble and capsize, and where they lose stability."""

import numpy as np

from symbody import linearize, modes, newton_euler, root_locus, step_response, symbols, time_derivative
from symbody.models import motorcycle

model = motorcycle()
phi, delta, tau = (model[name] for name in ("phi", "delta", "tau"))

# Straight running at the speed v, which stays a symbol. Nothing depends on the place and on the angles of the wheels.
v = symbols("v")
linear = linearize(
    newton_euler(model.system),
    about={time_derivative(model["x"]): v},
    inputs=[tau],
    outputs={"lean": phi, "steering angle": delta},
    keep_ignorable=False,
)
print(linear)

# The modes at 30 m/s, the fastest growing first.
at_30 = model.parameters | {v: 30}
found = modes(linear, at_30)
for mode in found:
    print(f"  {mode.description}")
wobble = found.near(-4 + 54j)
fork = next(body for body in wobble.kinetic_energies if body.name == "fork")
print(f"the fork has {wobble.kinetic_energies[fork]:.0%} of the kinetic energy of the wobble")

# `wobble.plot()` draws its phasors, and `wobble.animate("wobble.html")` swings the motorcycle.

# The same over the speed; `locus.plot(unit="m/s")` draws it. Branches keep their names where they cross.
names = {"weave": (30, -2 + 19j), "wobble": (30, -4 + 54j), "capsize": (30, 0.06)}
locus = root_locus(linear, model.parameters, over={v: np.linspace(5, 60, 500)}, names=names)
print(locus)

# Countersteering: a torque to the left, about the steering axis, turns the fork to the left and leans the frame, about
# the axis x that points forward, to the right.
step = step_response(linear, model.parameters | {v: 9}, 2)
print(f"a torque of 1 N m at 9 m/s: lean after 0.5 s {np.interp(0.5, step.t, step['lean', tau]):.4f} rad,")
print(f"steering angle after 0.05 s {np.interp(0.05, step.t, step['steering angle', tau]):.5f} rad")
assert step["lean", tau][100] > 0
assert step["steering angle", tau][10] > 0
