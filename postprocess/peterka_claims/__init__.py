"""The claims of the paper, each tested on files that jobs/paper.sh computes, and the page that tells how they fare.

`record` is what a claim says and how it fared; `folder` opens the computed files; gap_zero, force_map, jumps, robust,
stiffness, starts and sensitivity each return the claims of one group; `claims` collects them; `markdown` and `html` write the page.
"""
