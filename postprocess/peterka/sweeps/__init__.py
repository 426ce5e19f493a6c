"""Sweeps: the checked file (sweep_file), elements shared by the pictures (sweep_panels), response and bifurcation diagrams,
the band of drawn rigs (uncertain_response), and residuals of measured points (residuals)."""
