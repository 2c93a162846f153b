"""Commands of MBSymba, by family."""
