"""Parallel efficiency against ranks.

run_record   what a finished map tells of its run
tile_costs, dealing   times of tiles, and the replay of their dealing to ranks
efficiency, remedies  the picture of measured and replayed efficiency; ways out where it falls
"""
