"""One motion: `simulate`, and what is read, plotted and animated of it."""
