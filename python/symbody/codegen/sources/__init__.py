"""Source files: written into a folder, compiled and compared with reference values there."""
