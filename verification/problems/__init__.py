"""Contact problems with known answers: scenes, exact or tabulated solutions, and their sources."""
