"""Python tools of jointcal: simulator, recordings and float64 references.

Nothing here uses the C library: the references are written from the papers
alone, so that an agreement between the two means something.
"""
