"""Atomic replacement of files."""
