"""The user's input: values, functions, instants, tolerances and events. Each is checked before anything runs."""
