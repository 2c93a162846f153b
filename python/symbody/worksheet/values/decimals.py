"""Decimals in Maple's style: ``.5``, ``9.81``, ``1.``, ``.17e-1``."""

from __future__ import annotations

from decimal import Context, Decimal

__all__ = ["decimal_text", "rounded"]


def rounded(ratio: tuple[int, int], digits: int) -> Decimal:
    """Return a number with so many significant digits."""
    context = Context(prec=digits)
    return context.divide(Decimal(ratio[0]), Decimal(ratio[1]))


def decimal_text(ratio: tuple[int, int], digits: int, places: int | None = None) -> str:
    """Return a decimal as Maple prints it, with ``digits`` significant digits, or ``places`` behind the point."""
    value = rounded(ratio, digits)
    if places is not None:
        value = Context(prec=digits + places + abs(value.adjusted())).quantize(
            value, Decimal(1).scaleb(-places)
        )
    if not value:
        return "0."
    sign, figures, exponent = value.as_tuple()
    text = "".join(map(str, figures)).rstrip("0") or "0"
    exponent = int(exponent) + len(figures) - len(text)
    point = len(text) + exponent  # the place of the decimal point in the figures
    minus = "-" if sign else ""
    if 0 < point <= digits:
        whole, fraction = text[:point].ljust(point, "0"), text[point:]
        return f"{minus}{whole}.{fraction}"
    return f"{minus}.{text}" if point == 0 else f"{minus}.{text}e{point}"
