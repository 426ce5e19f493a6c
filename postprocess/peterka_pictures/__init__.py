"""Pictures of peterka's files, one module per picture.

interpreter   finds a Python that has the packages
checked_hdf5  single attributes and datasets of a file nobody vouches for
opened        a file of any kind with a checked header
read, tables  map and basin files: checks everything they say, and hands out bands of rows
reduce        brings a large map down to what a picture can show
classes       the fixed colour of each class of z = p/q
log_ticks, linear_ticks   ticks whose labels have room
titles, notes, units   titles and notes that have room, and amounts with prefixes
axes          axis labels, second scales and the pieces every picture shares
field_map     a number per cell: what force_map and quantity_map share
peterka_map, force_map, quantity_map, basin_map, audit_map   the pictures: each takes a file and returns a Figure
common_plane, comparison, comparison_map   two files compared at the points they have in common
study, trace_file   files of studies and traces, checked
methods       the fixed look of each method of integration
work_precision, labels, stability   the pictures of studies; study_words: their tables
motion, phase_plane, impact, spectrum   the pictures of a trace; trace_look: their lines and units
tile_costs, dealing   times of tiles, and the replay of their dealing to ranks
run_record, scaling, remedies   parallel efficiency against ranks: what was measured, the picture, ways out
results_page  the results page in Markdown
pictures      which pictures a file gives
command_line  what the programs share: exit codes, arguments, messages, saving
"""
