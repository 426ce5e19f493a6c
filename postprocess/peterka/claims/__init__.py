"""The claims of the paper, each tested on files that jobs/paper.sh computes, and the page that tells how they fare.

`record` is what a claim says, how it fared and by which limits; `folder` opens the computed files; gap_zero, pulse,
force_map, jumps, robust, drift, stiffness and starts each return the claims of one group; `claims` collects them; sensitivity tells
which parameter would remove a difference; `page` puts all together; `markdown` and `html` write it.
"""
