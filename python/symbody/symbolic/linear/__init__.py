"""Linear systems, solved in symbols or at run time: elimination, saddle points, null spaces."""
