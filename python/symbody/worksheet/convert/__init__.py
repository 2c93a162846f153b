"""``symbody convert``: a worksheet to a Python program that gives the same."""

from symbody.worksheet.convert.command import convert_file

__all__ = ["convert_file"]
