"""Fits: parameters and initial values from measured motions."""
