"""The classic systems of `symbody.models`, from bodies to a motion."""
