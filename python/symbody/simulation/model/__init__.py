"""What all motions of a system share: its functions of time and state, derived and compiled once."""
