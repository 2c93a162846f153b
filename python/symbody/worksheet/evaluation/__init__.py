"""A session, and what evaluates values in it: names, operators, conditions, entries, types."""
