"""Evaluation of equations of motion: compiled code of symbody beside Pinocchio and CasADi, in loops outside Python."""
