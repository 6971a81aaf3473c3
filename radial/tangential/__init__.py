"""Tangential load: shear on rings and angles, with stick and slip."""
