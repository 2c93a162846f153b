"""What a Maple name can hold, and scalars as Maple sees them: names, numbers, decimals, structure."""
