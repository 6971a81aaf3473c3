"""Programs that run other codes: each reads a JSON request and writes a JSON answer.

They run under the Python of the other codes and import nothing of this program but `exchange`. A
request has `cells`, `window`, `radius`, `modulus`, `force`, `friction`, `tangential_force` and
`tolerance`, in consistent units of the caller; with friction 0 only the pressure is computed. An
answer has `pressure`, `shear` (None without friction), `approach` (None if the code does not
provide it), `converged` and `seconds`; or `cannot`, with the reason.
"""
