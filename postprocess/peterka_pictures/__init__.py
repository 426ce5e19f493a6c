"""Pictures of peterka's map files, one module per picture.

checked_hdf5  single attributes and datasets of a file nobody vouches for
read        opens a map file, checks everything it says, and hands out bands of rows
reduce      brings a large map down to what a picture can show
classes     the fixed colour of each class of z = p/q
log_ticks   ticks of logarithmic axes whose labels have room
axes        axis labels, second scales and the pieces every picture shares
peterka_map, force_map, basin_map   the pictures: each takes a read.PeterkaFile and returns a matplotlib Figure
"""
