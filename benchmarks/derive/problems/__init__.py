"""One file a problem: its statement, who solves it, and the targets."""

from ..problem import Problem
from . import cart_pendulum, chain3d, euler_chain, net, rolling, trifilar

PROBLEMS: dict[str, Problem] = {
    problem.name: problem
    for problem in (
        chain3d.PROBLEM,
        euler_chain.PROBLEM,
        cart_pendulum.PROBLEM,
        trifilar.WORKSHEET,
        trifilar.OWN_FRAME,
        net.PROBLEM,
        rolling.PROBLEM,
    )
}
