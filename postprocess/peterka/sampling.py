"""What a number of draws, of starts or of rigs, tells of all: bounds that hold in 19 cases of 20.

A share s is missed by all of n independent draws with probability (1 - s)^n (Wilks, Ann. Math. Statist. 12 (1941) 91). At probability
1/20, 16 draws miss a share of 17 %, 59 a share of 5 %, 299 a share of 1 %. Draws of a low-discrepancy sequence scatter less.
"""

import numpy as np
from scipy.stats import beta

DOUBT = 0.05  # probability 1/20


def share_excluded(draws: int) -> float:
    """The share excluded by this many draws that all end elsewhere: one of that share would be missed with probability 1/20."""
    return float(1 - DOUBT ** (1 / draws))


def draws_needed(share: float) -> int:
    """The number of draws, all of one kind, that establishes such a share for it."""
    return int(np.ceil(np.log(DOUBT) / np.log(share) - 1e-9))


def least_share(share: float, draws: int) -> float:
    """Lower 95 % confidence bound on the share of all, given the share of these draws (Clopper & Pearson, 1934)."""
    found = round(share * draws)
    return float(beta.ppf(DOUBT, found, draws - found + 1)) if found else 0.0


def least_share_above(rank: int, draws: int) -> float:
    """Lower 95 % confidence bound on the share of all that reaches the draw of this rank, 1 being the smallest: what lies below an
    order statistic has a beta distribution, whatever that of the draws."""
    return float(1 - beta.ppf(1 - DOUBT, rank, draws - rank + 1))
