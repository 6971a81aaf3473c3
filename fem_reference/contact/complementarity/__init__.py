"""Contact and friction as complementarity problems, without a penalty."""
