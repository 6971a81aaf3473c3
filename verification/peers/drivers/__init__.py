"""Programs that run under the peers' Python: a request as JSON comes in, an answer goes out.

They import nothing of ours but `exchange`. A request has `cells`, `window`, `radius`, `modulus`,
`force`, `friction`, `tangential_force` and `tolerance`, all in the units of the caller; friction 0
asks for pressure alone. An answer has `pressure`, `shear` (None without), `approach` (None where
the code does not state it), `converged` and `seconds`; or `cannot`, with the reason.
"""
