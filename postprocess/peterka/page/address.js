// The view in the address, so that it can be kept and shared: layer, window, the cell looked at, and the rig's changes.

const VERSION = content.page_version; // of the program whose page this is: another one's rig may mean other things
const rounded = (value) => Number(value.toPrecision(9));

function writeAddress({ layer, view, place, rig, live }) {
  const parts = new URLSearchParams();
  if (layer !== "z") parts.set("layer", layer);
  const whole = (axis, range) => range[0] === axis.edges[0] && range[1] === axis.edges.at(-1);
  if (!whole(file.columns, view.x)) parts.set("x", view.x.map(rounded).join(","));
  if (!whole(file.rows, view.y)) parts.set("y", view.y.map(rounded).join(","));
  if (place) parts.set("at", place.join(","));
  for (const [name, value] of rig) parts.set(name, rounded(value));
  if (rig.length > 0) parts.set("version", VERSION);
  if (live) parts.set("live", "1");
  const text = parts.toString().replaceAll("%2C", ",");
  if (text !== location.hash.slice(1)) history.replaceState(null, "", text ? `#${text}` : location.pathname);
}

function readAddress() {
  const parts = new URLSearchParams(location.hash.slice(1));
  const pair = (name) => {
    const values = (parts.get(name) ?? "").split(",").map((text) => (text === "" ? NaN : Number(text)));
    return values.length === 2 && values.every(Number.isFinite) ? values : null;
  };
  const rising = (values) => (values && values[0] < values[1] ? values : null);
  return { layer: parts.get("layer") ?? "z", x: rising(pair("x")), y: rising(pair("y")), place: pair("at"), live: parts.has("live"), version: parts.get("version"),
    rig: [...parts] };
}
