"""The languages that code is printed in: one file for each target, and what the printers share."""
