"""Verification cases: a problem with a known answer, what is measured, and how far it may be off.

`case` says what a case is, `catalogue` lists them by level, `judgement` solves and judges one.
The remaining files hold one case each.
"""
