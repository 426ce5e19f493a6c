"""Shared by all pictures.

axes       figures, axis labels, second scales, legends, and other common elements
classes    the fixed colour of each class of z = p/q
log_ticks, linear_ticks   ticks whose labels have room
picture, style         the decorator that lets a function draw a file or a dataset into Axes, in a style
figures, frames        a picture's figure or its place in another one; layout of its parts, and their legends
fills      areas in colour, or in lightness and hatching
signed     scales around a middle, whose two sides differ in grey, too
drawn      protocols of the objects that are drawn
titles, notes, units      titles and notes placed where space permits, and amounts with prefixes
"""
