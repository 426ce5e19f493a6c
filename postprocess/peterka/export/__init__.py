"""Maps and basins for other programs, with force in N and axes in Hz, mm and m/s where the file tells the rig.

`cells`    the fields of a file's cells, named and in these units
`formats`  a table of cells as CSV, a rectilinear grid for ParaView (legacy VTK), a MATLAB file
"""
