// SPDX-License-Identifier: GPL-3.0-or-later
// Velocities of a skin's nodes as sums of shapes: six rigid motions, then elastic shapes.

const RIGID = 6;
const LIMIT_SHARE = 0.995; // of the nodes have colours inside the scale

/** Decodes a part's geometry once. */
async function readSkin(part) {
  const [points, normals, ends, triangles, edges, owner] = await allNumbers(
    part.points,
    part.normals,
    part.ends,
    part.triangles,
    part.edges,
    part.panels?.owner,
  );
  const scaled = new Float32Array(points.length);
  for (let k = 0; k < points.length; ++k) scaled[k] = part.low[k % 3] + part.step * points[k];
  return { points: scaled, normals, ends, triangles, edges, owner, corners: part.corners };
}

/** Rows of 16-bit numbers with one factor each. */
async function readRows(packed) {
  const [values, factor] = await allNumbers(packed.numbers, packed.factor);
  const width = values.length / Math.max(1, packed.count);
  return { count: packed.count, width, row: k => values.subarray(k * width, (k + 1) * width), factor };
}

/** Sum of amounts times shapes at the corners, and at mid-side nodes the mean of both ends of their edge: m/s, three per node. */
function combined(skin, shapes, amounts, factor, withRigid) {
  const found = new Float32Array(skin.points.length);
  for (let j = withRigid ? 0 : RIGID; j < shapes.count; ++j) {
    const amount = amounts[j] * factor * shapes.factor[j],
      row = shapes.row(j);
    if (amount === 0) continue;
    for (let k = 0; k < row.length; ++k) found[k] += amount * row[k];
  }
  return spread(skin, found);
}

function spread(skin, values) {
  const { ends, corners } = skin;
  for (let node = corners, k = 0; k < ends.length; ++node, k += 2)
    for (let axis = 0; axis < 3; ++axis)
      values[3 * node + axis] = 0.5 * (values[3 * ends[k] + axis] + values[3 * ends[k + 1] + axis]);
  return values;
}

/** One shape by itself. */
function single(skin, shapes, k) {
  const found = new Float32Array(skin.points.length),
    row = shapes.row(k);
  for (let i = 0; i < row.length; ++i) found[i] = shapes.factor[k] * row[i];
  return spread(skin, found);
}

/** What nearly all nodes stay below: of the normal component's amplitude, and of the amplitude. */
function limits(skin, re, im) {
  const count = skin.points.length / 3,
    normal = new Float32Array(count),
    whole = new Float32Array(count);
  for (let node = 0; node < count; ++node) {
    let [a, b, n, size] = [0, 0, 0, 0];
    for (let k = 3 * node; k < 3 * node + 3; ++k) {
      const direction = skin.normals[k],
        [x, y] = [re[k], im ? im[k] : 0];
      a += x * direction;
      b += y * direction;
      n += direction * direction;
      size += x * x + y * y;
    }
    normal[node] = Math.hypot(a, b) / Math.sqrt(n || 1);
    whole[node] = Math.sqrt(size);
  }
  const at = Math.floor(LIMIT_SHARE * (count - 1));
  return { normal: normal.sort()[at] || 1, whole: whole.sort()[at] || 1 };
}
