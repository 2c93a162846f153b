"""Code for any target: compiled in the process, or written as text."""
