"""Motions of frames, one kind per file: translation, rotations, bare matrices, floating frames. A joint is one."""
