"""Comparisons of engines: the checked file (study_file), the look of
each method (methods), the pictures, and their tables (study_words)."""
