"""The problems as a user of symbody writes them."""
