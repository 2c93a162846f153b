"""MBSymba worksheets: readers, an interpreter of the Maple subset that they use, and the commands of MBSymba."""
