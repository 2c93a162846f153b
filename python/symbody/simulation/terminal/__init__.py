"""Long computations at a terminal: progress bars and Ctrl-C."""
