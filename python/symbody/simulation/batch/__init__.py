"""Many motions: `simulate_many`, the workers that run them, and their results in memory and in files."""
