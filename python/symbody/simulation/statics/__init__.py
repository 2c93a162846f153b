"""States of rest: equilibria and small motions about them."""
