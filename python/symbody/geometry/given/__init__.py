"""What a user gives: arguments checked against their annotations, and angles with rounded multiples of pi."""
