"""Many motions: `simulate_many`, who runs them, their results in memory and in files."""
