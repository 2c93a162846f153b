"""What a user gives: names, numbers and lists, checked, and hints where a name is another program's."""
