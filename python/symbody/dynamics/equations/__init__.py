"""Equations of motion, as every formalism returns them, and their constraints."""
