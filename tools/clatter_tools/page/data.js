// SPDX-License-Identifier: GPL-3.0-or-later
// The page's data: JSON, and numbers in compressed blocks that are decoded when they are first needed.

const page = JSON.parse(document.getElementById("page-data").textContent);
const blocks = new Map();
const arrays = new WeakMap();
const KINDS = {
  f4: Float32Array,
  u1: Uint8Array,
  i1: Int8Array,
  u2: Uint16Array,
  i2: Int16Array,
  u4: Uint32Array,
  f8: Float64Array,
};

async function readBlock(name) {
  const holder = document.getElementById(`block-${name}`);
  const text = atob(holder.textContent);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = text.charCodeAt(k);
  holder.remove();
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Bytes in their order again: in a block those of equal weight are together. */
function joined(block, { at, kind, shape }) {
  const Kind = KINDS[kind],
    size = Kind.BYTES_PER_ELEMENT,
    count = shape.reduce((a, b) => a * b, 1);
  if (size === 1) return new Kind(block.buffer, at, count);
  const bytes = new Uint8Array(count * size);
  for (let plane = 0; plane < size; ++plane) {
    const from = at + plane * count;
    for (let k = 0, to = plane; k < count; ++k, to += size) bytes[to] = block[from + k];
  }
  return new Kind(bytes.buffer);
}

/** The numbers of a reference: integers with a scale become real ones. */
async function numbers(reference) {
  if (!reference) return null;
  if (arrays.has(reference)) return arrays.get(reference);
  if (!blocks.has(reference.block)) blocks.set(reference.block, readBlock(reference.block));
  let values = joined(await blocks.get(reference.block), reference);
  if (reference.scale !== undefined)
    values = Float32Array.from(values, one => reference.offset + reference.scale * one);
  arrays.set(reference, values);
  return values;
}

/** The same of several references. */
function allNumbers(...references) {
  return Promise.all(references.map(numbers));
}

/** 10 lg of powers over a reference; zero is left out. */
function decibel(values, reference) {
  return Float32Array.from(values, one => (one > 0 ? 10 * Math.log10(one / reference) : NaN));
}
