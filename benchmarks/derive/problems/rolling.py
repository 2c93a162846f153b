"""Wheels that roll: constraints on velocities, and dependent speeds."""

from __future__ import annotations

from ..by_kane import rolling as by_kane
from ..by_symbody import rolling as by_symbody
from ..by_symbody.formalism import FORMALISMS
from ..engines import SYMBODY, SYMPY
from ..problem import Contender, Problem, operations_target, time_target

KANE = Contender(SYMPY, "Kane", by_kane.mass_matrix_and_bias)


def _symbody(name: str) -> Contender:
    return Contender(SYMBODY, name, lambda n: by_symbody.mass_matrix_and_bias(FORMALISMS[name], n))


NEWTON_EULER = _symbody("newton_euler")


PROBLEM = Problem(
    name="rolling",
    title="Wheels that roll: n = 1 a disc, n = 2 a bicycle",
    statement=(
        "In space, the Carvallo-Whipple bicycle in the parameters of Meijaard and others (2007): four bodies, eight "
        "coordinates, six speeds. The rear wheel rolls by the choice of the speeds. The front contact is at rest: "
        "three constraints on velocities, by which yaw, pitch and the spin of the front wheel follow from the other "
        "three speeds. symbody's models are `models.rolling_disc` and `models.bicycle`, with `quasi_velocities=True`. "
        "All parameters symbolic. Outputs: M and bias of the independent equations, in all accelerations and without "
        "multipliers, and the same of the constraints."
    ),
    sizes=(1, 2),
    quick_sizes=(1,),
    contenders=(NEWTON_EULER, KANE),
    targets=(
        time_target(NEWTON_EULER.label, 2, 0.05),
        operations_target(NEWTON_EULER.label, 2, 1_250),
    ),
)
