"""The page that explore.py writes: a map, basin, sweep or file of curves with the program's own engine inside, in one HTML file.

planes     arrays of numbers as compressed bytes, exact or to so many digits
layers     what a file's cells say: labels of z and one layer per dataset
tracks     what the points of a sweep say: its branches, and the attractors that are known besides
edges      the curves of a file of curves, and the orbits on them
engine     the engine in WebAssembly (src/page), built when it is first needed, and the numbers of a cell for it
page       all of it put together
*.js, *.css, page.html   the page itself: files in the order of page.SCRIPTS, in one scope; worker.js runs beside it
"""
