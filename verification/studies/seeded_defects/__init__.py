"""Study that tests the verification: it must detect seeded defects and must pass
healthy contacts."""
