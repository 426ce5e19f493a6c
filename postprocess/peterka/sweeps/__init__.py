"""Sweeps: the checked file (sweep_file), elements shared by the pictures (sweep_panels), response and bifurcation diagrams,
and residuals of measured points (residuals)."""
