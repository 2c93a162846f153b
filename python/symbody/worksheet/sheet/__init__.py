"""A worksheet as data: cells with their places, statements as nodes, and what became of each."""
