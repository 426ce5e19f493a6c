"""The picture of a recording and its fit: all text lies on the canvas and overlaps nothing."""

from types import SimpleNamespace

import numpy as np
import pytest
from peterka.identification import picture
from picture_texts import faults_of_layout

LARGEST = {"force": 700.0, "acceleration": 2300.0, "displacement": 4.9e-3}


def fit(names, begin):
    """A Fit of one second at 1 kHz that begins at some time and has an impact in its middle."""
    def model(time):
        return {name: LARGEST[name] * np.exp(-np.square((time - 0.5) / 2e-3)) for name in names}

    step, count = 1e-3, 1001
    signals = {name: values * 1.02 for name, values in model(step * np.arange(count)).items()}
    return SimpleNamespace(
        solved=SimpleNamespace(problem=SimpleNamespace(names=names)), model=model, contacts=lambda: [(0.495, 0.505)],
        guess=SimpleNamespace(pulses=[SimpleNamespace(top=500)], hardest=0),
        recording=SimpleNamespace(begin=begin, step=step, count=count, signals=signals))


@pytest.mark.parametrize("names, begin", [(("force",), 0.0), (("force",), 1234.56789), (("acceleration", "displacement"), 1234.56789)])
def test_nothing_is_cut_or_written_over(monkeypatch, names, begin):
    figure = picture.draw(fit(names, begin), "A hammer let go")
    assert faults_of_layout(figure, monkeypatch) == []
    labels = [ax.get_xlabel() for ax in figure.axes if ax.get_xlabel()]
    assert len(labels) == 2 and labels[0] == "time (s)" and labels[1].endswith(" s (ms)")
