"""Points and vectors, their projections, velocities and accelerations."""
