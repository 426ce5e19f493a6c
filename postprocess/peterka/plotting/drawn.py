"""Protocols of the objects that are drawn: a file, a part of one, or two files together."""

from typing import Protocol

from ..arrays import Integers, Reals


class Titled(Protocol):
    """Has a title of one sanitised line."""

    @property
    def title(self) -> str: ...


class InUnits(Protocol):
    """Has positive scales in SI units, such as natural_frequency_hz; None for unknown ones."""

    def positive(self, name: str) -> float | None: ...


class AtPoint(InUnits, Protocol):
    """Also has plain numbers, which may be 0 or negative, and the coordinates that its job gives in SI units."""

    def number(self, name: str) -> float | None: ...

    @property
    def given_in_si(self) -> frozenset[str]: ...


class PlaneAxis(Protocol):
    """A side of a plane of n cells: its coordinate, cell centres (n,) and
    edges (n + 1,), and whether they are evenly spaced in the logarithm."""

    @property
    def name(self) -> str: ...

    @property
    def values(self) -> Reals: ...

    @property
    def edges(self) -> Reals: ...

    @property
    def log(self) -> bool: ...


class Plane(InUnits, Protocol):
    """Cells over two axes."""

    @property
    def rows(self) -> PlaneAxis: ...

    @property
    def columns(self) -> PlaneAxis: ...


class Growing(Protocol):
    """Has a computed share, 0 to 1, and is complete with whatever follows."""

    @property
    def computed(self) -> float: ...

    @property
    def is_complete(self) -> bool: ...


class Image(Protocol):
    """Class numbers or values, (rows, columns), with the edges of the rows and columns, each one longer."""

    @property
    def image(self) -> Integers | Reals: ...

    @property
    def row_edges(self) -> Reals: ...

    @property
    def column_edges(self) -> Reals: ...

    @property
    def log(self) -> tuple[bool, bool]: ...
