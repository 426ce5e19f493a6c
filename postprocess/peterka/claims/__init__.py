"""The paper's claims, each tested on files computed by jobs/paper.sh, and the page that reports the verdicts.

`record` holds a claim, its verdict and the limits used; `folder` opens the computed files; gap_zero, pulse, force_map,
jumps, robust, drift, stiffness and starts each return one group of claims; `claims` collects them; sensitivity finds the
parameter that would remove a difference; `page` assembles everything; `markdown` and `html` write it.
"""
