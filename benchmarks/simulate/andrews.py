"""Andrews' squeezing mechanism: seven bodies in the plane, a motor, a spring, three closed loops."""

from __future__ import annotations

from symbody import newton_euler
from symbody.models import andrews_mechanism
from tests.reference.mechanisms.problem import reference

from .problem import Problem, first_state


def andrews() -> Problem:
    """Return it over the 0.03 s of the literature, in which the crank turns two and a half times."""
    model = andrews_mechanism()
    return Problem(
        "Andrews' squeezing mechanism",
        newton_euler(model.system),
        model.parameters,
        first_state(model),
        0.03,
        tuple(reference("andrews")["published_solution_t003"]),
    )
