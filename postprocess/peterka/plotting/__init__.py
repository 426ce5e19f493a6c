"""What every picture shares.

axes       figures, axis labels, second scales, legends, and the pieces every picture shares
classes    the fixed colour of each class of z = p/q
log_ticks, linear_ticks   ticks whose labels have room
picture, style         what makes a function a picture that takes a file or a dataset, Axes and a style
figures, frames        a picture's figure or place in another one; how its parts stand, and their legends
fills      areas in colour, or in lightness and hatching
drawn      what these pieces ask of what is drawn
titles, notes, units      titles and notes that have room, and amounts with prefixes
"""
