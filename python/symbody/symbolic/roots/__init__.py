"""Equations that aren't linear, solved in closed form."""
