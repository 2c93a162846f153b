"""What is made of equations of motion: accelerations and multipliers, dependent speeds, programs for codegen."""
