"""Values, syntax and programs as text."""
