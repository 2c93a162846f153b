"""Atomic replacement of files, and the folder of what is kept between processes."""
