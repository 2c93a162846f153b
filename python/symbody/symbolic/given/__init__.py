"""Checks of what the user passes: names, numbers, lists; hints for users of other programs."""
