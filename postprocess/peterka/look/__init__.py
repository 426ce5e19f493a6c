"""What every picture shares.

axes       figures, axis labels, second scales, legends, and the pieces every picture shares
classes    the fixed colour of each class of z = p/q
log_ticks, linear_ticks   ticks whose labels have room
titles, notes, units      titles and notes that have room, and amounts with prefixes
"""
