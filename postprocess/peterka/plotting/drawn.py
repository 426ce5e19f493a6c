"""What the pieces of a picture ask of what is drawn: a file, a part of one, or two files together."""

from typing import Protocol

from ..arrays import Integers, Reals


class Titled(Protocol):
    """It has a title in one harmless line."""

    @property
    def title(self) -> str: ...


class InUnits(Protocol):
    """It knows scales in SI units, such as natural_frequency_hz, above 0; None for those that it doesn't know."""

    def positive(self, name: str) -> float | None: ...


class AtPoint(InUnits, Protocol):
    """It has numbers of its own, too, which may be 0 or below."""

    def number(self, name: str) -> float | None: ...


class PlaneAxis(Protocol):
    """A side of a plane of n cells: its coordinate, the cells' centres (n,) and borders (n + 1,), and whether they are evenly
    spaced in the logarithm."""

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
    """A share of it, 0 to 1, is computed."""

    @property
    def computed(self) -> float: ...


class Image(Protocol):
    """Numbers of classes, or values, (rows, columns), with the borders of the rows and columns, each one longer."""

    @property
    def image(self) -> Integers | Reals: ...

    @property
    def row_edges(self) -> Reals: ...

    @property
    def column_edges(self) -> Reals: ...

    @property
    def log(self) -> tuple[bool, bool]: ...
