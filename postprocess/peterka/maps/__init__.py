"""Maps and basins.

map_file, tables   the file, checked, handed out in bands of rows
reduce     brings a large map down to what a picture can show
field_map  a number per cell: what force_map, quantity_map and number_map share
peterka_map, force_map, quantity_map, number_map, basin_map, audit_map, computed_map, last_impact   the pictures
common_plane, comparison, comparison_map   two files compared at the points they have in common
"""
