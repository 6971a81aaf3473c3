"""Laws of mechanics that the surface response of elastic layered bodies obeys, as tests."""
