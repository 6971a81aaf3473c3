"""Contact of two bodies that are known by their compliances."""
