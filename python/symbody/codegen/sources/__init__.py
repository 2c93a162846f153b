"""Source files: write them into a folder, compile them there and compare with reference values."""
