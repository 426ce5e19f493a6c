"""A second proof of what a file tells of a periodic cell, by other means than the program's own, with which it shares nothing:
another language, another arithmetic (whole numbers of any length) and another method.

balls.py     numbers enclosed by balls, in fixed-point arithmetic of Python's integers, which is exact
motion.py    the equation of motion, and Taylor steps of all motions from a small box, with their derivative
shooting.py  q cycles from a box, through all contacts in their order; what they prove of the box
guessing.py  the orbit and its contacts in floating-point numbers, by scipy: a guess, of which nothing is trusted
cells.py     what a file claims of its cells, and what becomes of each claim
"""
