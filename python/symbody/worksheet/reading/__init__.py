"""Reading worksheets: files to cells, and cells to statements."""

from symbody.worksheet.reading.files import read_source
from symbody.worksheet.reading.statements import statements

__all__ = ["read_source", "statements"]
