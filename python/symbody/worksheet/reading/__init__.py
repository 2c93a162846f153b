"""Reading worksheets: files to cells, and cells to statements."""

from symbody.worksheet.reading.files import read_source
from symbody.worksheet.reading.mistake import located
from symbody.worksheet.reading.statements import names_in_code, statements

__all__ = ["located", "names_in_code", "read_source", "statements"]
