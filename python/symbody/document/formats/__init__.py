"""Formats: one file per kind of document, which prints all parts of it."""
