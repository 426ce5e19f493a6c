// Unpacks the number arrays packed by planes.py: each becomes a function from a cell's index to its value.

async function unpacked(text) {
  const stream = new Blob([fromBase64(text)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function fromBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

// Bytes of equal weight are stored together, the least significant first.
function byWeight(bytes, size, from = 0) {
  const count = (bytes.length - from) / size;
  if (size === 1) return bytes.subarray(from);
  const whole = new Uint8Array(count * size);
  for (let weight = 0; weight < size; ++weight) {
    const plane = from + weight * count;
    for (let i = 0, to = weight; i < count; ++i, to += size) whole[to] = bytes[plane + i];
  }
  return whole;
}

function planeOf(description, bytes, columns) {
  if (description.as === "integers") {
    const Whole = { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array }[description.bytes];
    const whole = byWeight(bytes, description.bytes);
    const values = new Whole(whole.buffer, whole.byteOffset, whole.byteLength / description.bytes);
    const low = description.low;
    return { raw: values, low, at: (i) => values[i] + low };
  }
  if (description.as === "reals") {
    const values = new Float64Array(byWeight(bytes, 8).buffer);
    return { at: (i) => values[i] };
  }
  return shortReals(description.bits, bytes, columns);
}

// Numbers with a shortened mantissa, each stored as the difference from a prediction by its neighbours.
function shortReals(bits, bytes, columns) {
  const count = bytes.length / 5;
  const mask = bytes.subarray(0, count);
  const numbers = new Uint32Array(byWeight(bytes, 4, count).buffer);
  for (let i = 0; i < count; ++i) {
    const folded = numbers[i];
    let value = (folded >>> 1) ^ -(folded & 1);
    const inside = i % columns > 0;
    if (inside) value += numbers[i - 1];
    if (i >= columns) value += numbers[i - columns] - (inside ? numbers[i - columns - 1] : 0);
    numbers[i] = value;
  }
  const real = new Float64Array(1);
  const words = new Uint32Array(real.buffer);
  const at = (i) => {
    if (mask[i] > 0) return mask[i] === 1 ? 0 : NaN;
    words[1] = numbers[i] << (20 - bits);
    return real[0];
  };
  return { at };
}
