"""Python tools of jointcal: simulator, recordings, float64 references, measurements.

The references (ols20, lai22) and the simulators use nothing of the C library: they are
written from the papers alone, so that an agreement between the two means something.
`native` runs the C library, `measure` holds what tools/measure.py measures with it.
"""
