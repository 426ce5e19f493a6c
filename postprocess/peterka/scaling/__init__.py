"""Parallel efficiency against ranks.

run_record   what a finished map records of its run
tile_costs, dealing   tile times, and the replay of their distribution to ranks
efficiency, remedies  the picture of measured and replayed efficiency; remedies where it drops
"""
