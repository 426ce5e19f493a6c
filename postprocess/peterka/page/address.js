// Stores the view in the address, so that it can be kept and shared: layer, window, selected place, and changes of the rig.

const VERSION = content.page_version; // version of the program that wrote this page: rigs of other versions may mean something else
const rounded = (value) => Number(value.toPrecision(9));

// axes, view: {x, y} of the plane; at: numbers of the selected place, by their names in the address; live: null where it is as the
// rig would have it.
function writeAddress({ layer, axes, view, at, rig, live }) {
  const parts = new URLSearchParams();
  if (layer !== undefined) parts.set("layer", layer);
  for (const side of ["x", "y"]) {
    const whole = view[side][0] === axes[side].edges[0] && view[side][1] === axes[side].edges.at(-1);
    if (!whole) parts.set(side, view[side].map(rounded).join(","));
  }
  for (const [name, numbers] of Object.entries(at)) parts.set(name, numbers.join(","));
  for (const [name, value] of rig) parts.set(name, rounded(value));
  if (rig.length > 0) parts.set("version", VERSION);
  if (live !== null) parts.set("live", live ? "1" : "0");
  const text = parts.toString().replaceAll("%2C", ",");
  if (text !== location.hash.slice(1)) history.replaceState(null, "", text ? `#${text}` : location.pathname);
}

const KNOWN_PARTS = ["layer", "x", "y", "at", "curve", "gap", "live", "version"]; // parts of an address; all others describe the rig

function readAddress() {
  const parts = new URLSearchParams(location.hash.slice(1));
  const pair = (name) => {
    const values = (parts.get(name) ?? "").split(",").map((text) => (text === "" ? NaN : Number(text)));
    return values.length === 2 && values.every(Number.isFinite) ? values : null;
  };
  const rising = (values) => (values && values[0] < values[1] ? values : null);
  return { layer: parts.get("layer"), x: rising(pair("x")), y: rising(pair("y")), at: pair("at"), curve: pair("curve"),
    gap: parts.has("gap") ? Number(parts.get("gap")) : null, live: parts.has("live") ? parts.get("live") !== "0" : null, version: parts.get("version"), rig: [...parts].filter(([name]) => !KNOWN_PARTS.includes(name)) };
}
