"""Contact with friction between two bodies that are represented by their surface compliances.

The package `compliance` defines rings and rays.
"""
