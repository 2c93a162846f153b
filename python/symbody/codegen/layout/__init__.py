"""From straight-line code to statements of routines, with the names of a language but not yet in its syntax."""
