"""The claims of the paper, in its order, each beside what follows from its premises.

Nothing here uses the formulas of `jkroll.physics`: what follows is integrated, differentiated and solved anew.
"""
