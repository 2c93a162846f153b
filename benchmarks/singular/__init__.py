"""The scan of motions through singular positions."""
