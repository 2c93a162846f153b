"""Linear models: small deviations from a steady motion, with the constraints eliminated in symbols."""
