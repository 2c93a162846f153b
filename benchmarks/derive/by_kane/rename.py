"""The names of speeds."""

from __future__ import annotations

import re


def speeds_as_rates(name: str) -> str:
    """Call the speed u1 q1', as the other contenders do."""
    return re.sub(r"^u(\d+)$", r"q\1'", name)
