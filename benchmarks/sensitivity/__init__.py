"""Benchmark: sensitivities of a double pendulum, against difference quotients, CasADi with CVODES, and JAX."""
