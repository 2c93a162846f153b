"""Benchmarks of symbody against its rivals."""
