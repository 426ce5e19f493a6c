"""A single cell in time: the checked file (trace_file), lines and units (trace_look), and the pictures: motion, phase_plane,
relative_plane with the stop and the Poincaré points, impact, spectrum."""
