"""Inverse dynamics: the loads that make a system follow a prescribed motion."""
