"""The notebook's cells, run in order as a kernel would (jupyter itself is not a test dependency)."""

import ast
import json

import pytest
from conftest import POSTPROCESS
from matplotlib.figure import Figure

NOTEBOOK = POSTPROCESS / "examples" / "peterka.ipynb"


@pytest.fixture(scope="module")
def ran():
    """(names of the notebook, output of each code cell)"""
    names, shown = {}, []
    for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] != "code":
            continue
        tree = ast.parse("".join(cell["source"]))
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, NOTEBOOK.name, "exec"), names)
        shown.append(eval(compile(ast.Expression(last.value), NOTEBOOK.name, "eval"), names) if last else None)
    return names, shown


def test_it_takes_ten_cells_and_shows_its_pictures(ran):
    _, shown = ran
    assert len(shown) == 10
    assert sum(isinstance(value, Figure) for value in shown) == 4


def test_its_operating_point_is_one_by_brute_force(ran):
    """All 25 surrounding cells are z = 1/1, and no other such place has a larger smallest force."""
    names, _ = ran
    cells = names["cells"]
    label = ((cells.regime == 1) & (cells.impacts == 1) & (cells.period == 1)).values
    force = cells.peak_force_ratio.values
    weakest = {(row, column): force[row - 2:row + 3, column - 2:column + 3].min()
               for row in range(2, force.shape[0] - 2) for column in range(2, force.shape[1] - 2)
               if label[row - 2:row + 3, column - 2:column + 3].all()}
    row, column = max(weakest, key=weakest.get)
    assert float(names["best"]) == weakest[row, column]
    assert names["point"] == {"frequency_ratio": float(cells.frequency_ratio[column]),
                              "gap_ratio": float(cells.gap_ratio[row])}


def test_it_is_stored_without_outputs():
    for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]:
        assert not cell.get("outputs") and cell.get("execution_count") is None
