"""The harness tests itself: defects that it must see, healthy runs that it must pass."""
