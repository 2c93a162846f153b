"""What a user gives: values, inputs, instants, tolerances and events. Each is checked before anything runs."""
