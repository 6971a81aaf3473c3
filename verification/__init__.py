"""How good the answers are: closed forms, cases, metrics, reports and the command `slipstick`.

The only package that knows both solvers. Nothing but tests and examples imports it.
"""
