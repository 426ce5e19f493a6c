"""Maps and basins.

map_file, tables   the checked file, read in bands of rows
reduce     reduces a large map to picture size
field_map  a number per cell: shared by force_map, quantity_map and number_map
peterka_map, force_map, quantity_map, number_map, basin_map, audit_map, computed_map, last_impact   the pictures
outcomes, uncertain_map   what rigs drawn for each cell do, and its pictures
common_plane, comparison, comparison_map   comparison of two files at their common points
"""
