"""What the Makefile runs, also before there is an environment."""
