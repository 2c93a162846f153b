"""The table of classic systems, of which docs/textbook.md is made."""

from __future__ import annotations

from .bicycle import BICYCLES
from .carts import CARTS
from .classic import Classic
from .elementary import ELEMENTARY
from .engineering import ENGINEERING
from .machines import MACHINES
from .pendulums import PENDULUMS
from .robots import ROBOTS
from .rolling import ROLLING
from .spatial import SPATIAL
from .turning import TURNING
from .vehicles import VEHICLES

CLASSICS: tuple[Classic, ...] = (
    *PENDULUMS,
    *MACHINES,
    *ELEMENTARY,
    *CARTS,
    *ENGINEERING,
    *TURNING,
    *ROBOTS,
    *VEHICLES,
    *ROLLING,
    *SPATIAL,
    *BICYCLES,
)
