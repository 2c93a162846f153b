"""Linear models with numbers: matrices for many parameter sets, and what other programs take."""
