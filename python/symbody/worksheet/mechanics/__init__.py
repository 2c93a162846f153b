"""MBSymba's objects, which are tables, the two faces of its frames, and the modes in which commands work."""
