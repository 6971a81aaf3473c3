"""Drawn scenes whose answer is known from elsewhere: materials, loads, histories, grids."""
