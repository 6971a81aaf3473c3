"""How good the answers are: problems with known answers, judging, cases, studies, report.

It judges and does not serve: nothing but tests and, lazily, the command imports it.
"""
