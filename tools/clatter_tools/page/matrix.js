// SPDX-License-Identifier: GPL-3.0-or-later
// 4 x 4 matrices, column by column as WebGL has them, and what they show at a pixel.

function multiplied(a, b) {
  const found = new Float32Array(16);
  for (let column = 0; column < 4; ++column)
    for (let row = 0; row < 4; ++row)
      for (let k = 0; k < 4; ++k) found[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return found;
}

/** Rows right, up, toward the viewer, of an eye at azimuth and elevation [rad] that looks at `centre`; z is up. */
function viewMatrix(azimuth, elevation, centre) {
  const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
  const rows = [
    [-sa, ca, 0],
    [-se * ca, -se * sa, ce],
    [ce * ca, ce * sa, se],
  ];
  const found = new Float32Array(16);
  rows.forEach((row, k) => {
    for (let j = 0; j < 3; ++j) found[4 * j + k] = row[j];
    found[12 + k] = -row.reduce((sum, one, j) => sum + one * centre[j], 0);
  });
  found[15] = 1;
  return found;
}

/** Parallel projection of a box of half sizes about a middle, so that lengths may be compared. */
function parallelMatrix(halfWidth, halfHeight, halfDepth, [x, y]) {
  return Float32Array.from([
    1 / halfWidth,
    0,
    0,
    0,
    0,
    1 / halfHeight,
    0,
    0,
    0,
    0,
    -1 / halfDepth,
    0,
    -x / halfWidth,
    -y / halfHeight,
    0,
    1,
  ]);
}

/** Pixels and depth of points, three per node, smaller nearer to the viewer. */
function projected(points, matrix, width, height) {
  const found = new Float32Array(points.length);
  for (let at = 0; at < points.length; at += 3) {
    const [x, y, z] = [0, 1, 2].map(
      row =>
        matrix[row] * points[at] +
        matrix[4 + row] * points[at + 1] +
        matrix[8 + row] * points[at + 2] +
        matrix[12 + row],
    );
    found[at] = 0.5 * (x + 1) * width;
    found[at + 1] = 0.5 * (1 - y) * height;
    found[at + 2] = z;
  }
  return found;
}

/** The face of four triangles that is seen at a pixel, or null. */
function faceAt(seen, triangles, x, y) {
  let [best, depth] = [null, Infinity];
  for (let at = 0; at < triangles.length; at += 3) {
    const [a, b, c] = [3 * triangles[at], 3 * triangles[at + 1], 3 * triangles[at + 2]];
    const side = (p, q) => (seen[q] - seen[p]) * (y - seen[p + 1]) - (seen[q + 1] - seen[p + 1]) * (x - seen[p]);
    const [u, v, w] = [side(b, c), side(c, a), side(a, b)],
      whole = u + v + w;
    if (whole === 0 || u * whole < 0 || v * whole < 0 || w * whole < 0) continue;
    const z = (u * seen[a + 2] + v * seen[b + 2] + w * seen[c + 2]) / whole;
    if (z < depth) [best, depth] = [Math.floor(at / 12), z];
  }
  return best;
}
