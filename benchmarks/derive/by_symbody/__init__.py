"""The problems as a user of symbody writes them: where `symbody.models` has the system, by its function."""
