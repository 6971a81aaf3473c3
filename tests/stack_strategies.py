"""Hypothesis strategies for layered bodies and wave vectors, over the supported range of the
FRFs."""

from hypothesis import strategies as st

from semi_analytical.frf.stack import Stack

MODULI = st.floats(-3, 3).map(lambda decade: 10**decade)
RATIOS = st.floats(-0.95, 0.5) | st.sampled_from([0.0, 0.3, 0.5])
THICKNESSES = st.floats(-2, 2).map(lambda decade: 10**decade)
HALF_SPACES = st.tuples(MODULI, RATIOS)
FILMS = st.tuples(MODULI, RATIOS, THICKNESSES)
COMPLIANCES = st.just(0.0) | st.floats(-3, 3).map(lambda decade: 10**decade)
BONDED = st.tuples(MODULI, RATIOS, THICKNESSES, COMPLIANCES, COMPLIANCES)


def stacks(
    min_layers: int = 0, max_layers: int = 5, rigid: bool = True, bonds: bool = False
) -> st.SearchStrategy[Stack]:
    """Layers on a half-space or, if there is a layer to deform, on a rigid base; with compliant
    bonds if asked for."""
    film = BONDED if bonds else FILMS
    elastic = st.builds(
        Stack, st.lists(film, min_size=min_layers, max_size=max_layers), HALF_SPACES
    )
    if not rigid:
        return elastic
    films = st.lists(film, min_size=max(1, min_layers), max_size=max_layers)
    return elastic | st.builds(Stack, films)
