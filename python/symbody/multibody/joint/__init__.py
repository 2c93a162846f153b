"""Joints between links, one kind per file; what they hold, and the mechanism that is assembled of them."""
