"""What a user at a terminal sees of long work, and Ctrl-C."""
