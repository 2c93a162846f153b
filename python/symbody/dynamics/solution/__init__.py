"""Results of equations of motion: accelerations and multipliers, dependent speeds, programs for codegen."""
