"""Many motions on a graphics processor: the text of the kernel, and the driver that runs it."""
