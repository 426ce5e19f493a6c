"""Where to operate a rig: the place of a map whose worst value over a drift and over the starts is the best.

`admitted`   the one regime that the admitted starts of a cell end in, and the worst value over them
`drift`      how far a drift in Hz and mm reaches on a map's axes; the worst over such a box around each cell
`places`     the best separate places
`told`       what of all that is proved, what sampled, and which known motions are left out
`verify`     the box around a place once more, on a finer grid, by the program
`picture`, `words`   what came out
"""
