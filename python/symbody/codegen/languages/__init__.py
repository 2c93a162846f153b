"""The languages that code is printed in: one file for each target, and the common parts of the printers."""
