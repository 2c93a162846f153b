"""Machine code in the process: straight-line code as text of LLVM's intermediate representation, compiled."""
