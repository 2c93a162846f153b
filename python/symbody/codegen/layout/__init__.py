"""From straight-line code to named statements of routines, in the names of a language and in no syntax yet."""
