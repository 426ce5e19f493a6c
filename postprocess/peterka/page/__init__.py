"""The page written by explore.py: a map, basin, sweep or file of curves with the program's own engine, in one HTML file.

planes     arrays of numbers as compressed bytes, exact or to a given precision
layers     contents of a file's cells: labels of z and one layer per dataset
tracks     contents of a sweep's points: its branches, and other known attractors
edges      the curves of a file of curves, and the orbits on them
engine     the engine in WebAssembly (src/page), built on first use, and the numbers of a cell for it
page       assembles the page
*.js, *.css, page.html   the page itself: files in the order of page.SCRIPTS, in one scope; worker.js runs beside it
"""
