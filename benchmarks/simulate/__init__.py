"""Simulation: symbody's compiled integrators beside SciPy's solve_ivp and JAX, on the same equations."""
