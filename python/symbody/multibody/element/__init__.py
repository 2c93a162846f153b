"""Elements: springs, motors, friction, contacts and tyres, each a function that returns a load."""
