"""The page that explore.py writes: a map or basin with the program's own engine inside, in one HTML file.

planes     arrays of numbers as compressed bytes, exact or to so many digits
layers     what a file's cells say: labels of z and one layer per dataset
engine     the engine in WebAssembly (src/page), built when it is first needed, and the numbers of a cell for it
page       all of it put together
*.js, *.css, page.html   the page itself: files in the order of page.SCRIPTS, in one scope; worker.js runs beside it
"""
