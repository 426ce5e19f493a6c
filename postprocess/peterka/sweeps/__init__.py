"""Sweeps: the checked file (sweep_file), what the pictures share (sweep_panels), response and bifurcation, and
measured points over them (measured) and how far they are from it (residuals)."""
