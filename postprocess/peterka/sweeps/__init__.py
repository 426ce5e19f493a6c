"""Sweeps: the checked file (sweep_file), what the pictures share (sweep_panels), response and bifurcation, and
how far measured points are from them (residuals)."""
