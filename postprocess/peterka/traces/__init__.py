"""One cell in time: the checked file (trace_file), lines and units (trace_look), and the pictures."""
