"""Adapters by which this program's solvers and other codes solve the challenges, in one form."""
