"""One motion: `simulate`, and how its result is read, plotted and animated."""
