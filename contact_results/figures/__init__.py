"""Figures of a run and of a stress, drawn with matplotlib, and their HTML pages."""

from matplotlib import artist
from matplotlib.artist import Artist

# matplotlib writes the documentation of each of its 100 artist classes when it is imported. This
# takes about .1 s, a third of the import; the figures do not use it.
Artist._update_set_signature_and_docstring = classmethod(lambda cls: None)  # type: ignore[attr-defined]
artist.kwdoc = lambda *_: ""
