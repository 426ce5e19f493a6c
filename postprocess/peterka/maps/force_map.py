"""Peak impact force over the plane of a map: of z = 1/1 alone (the paper's Fig. 23), and of all impacts.

Forces are F/(m g), with a second scale in newtons if the file gives the hammer's mass. A rigid stop yields impacts without a
force; if no cell has a force there is no picture.
"""

from collections.abc import Callable

from matplotlib.axes import Axes

from ..arrays import Mask
from ..files.regimes import PERIODIC
from ..plotting import style, units
from ..plotting.coordinates import either
from ..plotting.limits import WEIGHTS
from ..plotting.picture import picture
from ..measurements.points import NOTHING_MEASURED, Measurements
from . import field_map
from .field_map import Field, Scale
from .map_file import PeterkaFile


@picture(PeterkaFile)
def draw_single_impact(file: PeterkaFile, ax: Axes | None = None, *, measured: Measurements = NOTHING_MEASURED) -> Axes | None:
    """Force for one impact per forcing cycle, z = 1/1, as Axes; None if no cell has one."""
    carries = lambda regime, p, q: (regime == PERIODIC) & (p == 1) & (q == 1)  # noqa: E731
    return _draw(file, ax, carries, "$z = 1/1$", (), measured)


@picture(PeterkaFile)
def draw_all_impacts(file: PeterkaFile, ax: Axes | None = None, *, measured: Measurements = NOTHING_MEASURED) -> Axes | None:
    """Force of every verified orbit with impacts, and of chaos over its observation window, as Axes; None if no cell has one."""
    return _draw(file, ax, field_map.has_impacts, "all impacts", field_map.WITHOUT_IMPACTS, measured)


def _draw(file: PeterkaFile, ax: Axes | None, carries: Callable[..., Mask], what: str, apart: tuple[str, ...],
          measured: Measurements) -> Axes | None:
    newtons = file.newtons if style.current().units != "ratio" else None

    def text(force: float) -> str:
        return either(file, units.amount(force * newtons, "N") if newtons else "", units.number(force))

    def scale(largest: float) -> Scale:
        label = f"peak force $F/(m\\,g)$, {what}"
        if not newtons:
            return Scale(label, 1, text, ratio=WEIGHTS)
        factor, unit = units.with_prefix(largest * newtons, "N")
        alone = f", {what}" if style.current().units == "si" else ""
        return Scale(label, 1, text, (f"peak force ({unit}){alone}", newtons * factor), ("N", newtons), WEIGHTS)

    return field_map.draw(file, Field("peak_force_ratio", carries, apart, scale), ax, measured)
