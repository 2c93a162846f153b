"""Sections: one file per section of a report, each a function from the subject to its blocks."""
