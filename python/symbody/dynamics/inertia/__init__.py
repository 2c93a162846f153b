"""Inertias and wrenches on the frames of the tree: rigid bodies, composites, articulated bodies, base parameters."""
