// Starts the page for the file's kind. For scripts: value(row, column) is the file's, solve(row, column) a promise of the engine's; for a
// sweep, row is a branch and column a point of it. For curves, beside(curve, point) is a promise of the motions on either side.

const pages = { sweep: SweepPage, curves: CurvesPage };
const page = new (pages[content.kind] ?? MapPage)();
page.begun = page.begin();
window.peterka = {
  ready: page.begun.then(() => undefined),
  value: (row, column) => file.value(row, column),
  solve: async (row, column) => {
    await page.ready();
    return page.solve(row, column);
  },
  beside: async (curve, point) => {
    await page.ready();
    return page.beside(curve, point);
  },
};
