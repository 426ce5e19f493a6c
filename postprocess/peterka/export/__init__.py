"""Exports maps and basins to other programs, with force in N and axes in Hz, mm and m/s if the file gives the rig.

`cells`    the fields of a file's cells, with names and units
`traces`   the tables of a trace, in the same way
`formats`  a table of cells as CSV, a rectilinear grid for ParaView (legacy VTK), a MATLAB file
"""
