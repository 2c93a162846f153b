"""The kinematic tree: frames between the root and the bodies, and what each speed does to their motions."""
