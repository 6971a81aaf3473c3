"""Stress below a contact: points, maxima, files."""
