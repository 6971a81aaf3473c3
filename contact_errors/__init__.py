"""How far off the numbers of a result may be: coarser solves beside it, and what follows from them.

`on_cells` and `on_elements` know which companions a solver's result needs and what their
differences mean; `estimate` puts them together; `rules` holds what was measured.
"""
