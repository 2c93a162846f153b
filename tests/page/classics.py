"""The table of classic systems, of which docs/textbook.md is made."""

from __future__ import annotations

from .carts import CARTS
from .classic import Classic
from .pendulums import PENDULUMS
from .robots import ROBOTS
from .vehicles import VEHICLES

CLASSICS: tuple[Classic, ...] = (*PENDULUMS, *CARTS, *ROBOTS, *VEHICLES)
