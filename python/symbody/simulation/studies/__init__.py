"""Studies: samples of parameters, what is kept of many motions, indices of sensitivity, and fits to measurements."""
