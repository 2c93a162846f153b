"""Linear systems, solved in symbols or by a node that is solved at run time: saddle points, null spaces, LDL."""
