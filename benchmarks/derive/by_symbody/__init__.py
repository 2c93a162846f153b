"""The problems as a user of symbody writes them.

They are systems of their own beside those of `symbody.models`: all contenders derive the same thing from the same
symbols, and the gallery's cart has a pole with inertia, friction and an input, its disc five coordinates with
multipliers, and its bicycle joints. The tests check that the gallery's cart is this one where its poles are points.
"""
