"""What a user gives: values, inputs, instants, tolerances, events; each is looked at before anything runs."""
