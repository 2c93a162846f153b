"""The problems as a user of symbody writes them.

Three of them are systems of `symbody.models` in other variables, because all contenders derive the same thing from the
same symbols: the cart counts angles as SymPy's own model does and has points for poles, and disc and bicycle have
quasi-velocities in place of multipliers. The tests check that these are the systems of the gallery, by value.
"""
