"""Choice of an operating point: the place of a map with the best worst-case value over a drift and over the starts.

`admitted`   the single regime in which the admitted starts of a cell end, and the worst value over them
`drift`      the extent of a drift in Hz and mm on a map's axes; the worst value over such a box around each cell
`places`     the best separate places
`told`       which of the findings are proved, which sampled, and which known motions are excluded
`verify`     recomputes the box around a place on a finer grid, with the program
`risk`       the value reached with a probability by drawn rigs, over a drift
`fresh_draws`  many more rigs drawn for one place
`picture`, `words`   the results
"""
