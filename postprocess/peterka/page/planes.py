"""Arrays of numbers for a page: compressed bytes that a browser decompresses natively (zlib), and a description of their format.

An integer is stored minus the array's smallest value, in the fewest bytes; a real number as is, or with a reduced number of
mantissa bits. Bytes of equal weight are stored together. Shortened numbers are stored as differences from a prediction by
their left, lower and lower left neighbours; zeros and NaNs are skipped and recorded in a mask. JavaScript reader: planes.js.
"""

import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Integers, Mask, Reals

EXACT = 52  # bits of a mantissa
SHORT_BITS = (20, 18, 16, 14, 12, 10, 8)  # of shortened numbers: six digits down to two
NORMAL, ZERO, NOT_A_NUMBER = 0, 1, 2


def integers(values: Integers) -> tuple[dict[str, Any], bytes]:
    """(description, bytes) of an array of integers."""
    low, high = int(values.min()), int(values.max())
    size = next(size for size in (1, 2, 4) if high - low < 256**size)
    shifted = (values.astype(np.int64) - low).astype(f"<u{size}")
    return {"as": "integers", "low": low, "bytes": size}, zlib.compress(_by_weight(shifted), 6)


def reals(values: Reals) -> tuple[dict[str, Any], bytes]:
    """(description, bytes) of an array of real numbers, to the last bit."""
    return {"as": "reals"}, zlib.compress(_by_weight(values.astype("<f8")), 6)


def short_reals(values: Reals, bits: int) -> tuple[dict[str, Any], bytes]:
    """(description, bytes) of an array (rows, columns) of numbers >= 0, their mantissas rounded to `bits` bits."""
    if not bits <= 20 or np.any(values < 0):
        raise ValueError("only numbers from 0 up, of at most 20 bits, are shortened")
    mask = np.where(np.isnan(values), NOT_A_NUMBER, np.where(values == 0, ZERO, NORMAL)).astype(np.uint8)
    shift = 52 - bits
    whole = np.where(mask == NORMAL, values, 0).astype("<f8").view("<u8")
    rounded = ((whole + np.uint64(1 << (shift - 1))) >> np.uint64(shift)).astype(np.uint32)
    filled = _carried_on(rounded, mask == NORMAL)
    expected = np.zeros_like(filled)
    expected[:, 1:] += filled[:, :-1]
    expected[1:] += filled[:-1]
    expected[1:, 1:] -= filled[:-1, :-1]
    difference = (filled - expected).view(np.int32)
    folded = ((difference << 1) ^ (difference >> 31)).astype("<u4")  # zigzag: small numbers of either sign become small
    packed = zlib.compress(mask.tobytes() + _by_weight(folded), 6)
    return {"as": "short", "bits": bits, "digits": int(bits * np.log10(2))}, packed


def _carried_on(values: NDArray[np.uint32], valid: Mask) -> NDArray[np.uint32]:
    """Each row with invalid entries replaced by the last valid one before them; 0 if there is none."""
    place = np.where(valid, np.arange(values.shape[1]), -1)
    last = np.maximum.accumulate(place, axis=1)
    return np.where(last >= 0, np.take_along_axis(values, np.maximum(last, 0), axis=1), 0).astype(np.uint32)


def _by_weight(values: NDArray[Any]) -> bytes:
    return np.ascontiguousarray(values.reshape(-1, 1).view(np.uint8).T).tobytes()
