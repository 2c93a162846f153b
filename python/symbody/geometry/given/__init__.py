"""The user's input: arguments checked against their annotations, and angles with rounded multiples of pi."""
