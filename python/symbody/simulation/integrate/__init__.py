"""From a task to a motion as it was integrated: methods, what they need, what came out, what to say of it."""
