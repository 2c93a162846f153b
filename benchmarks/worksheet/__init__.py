"""The time that worksheets take, from the command to the last line."""
