// SPDX-License-Identifier: GPL-3.0-or-later
// 4 x 4 matrices, column by column as WebGL has them.

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
  const rows = [[-sa, ca, 0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]];
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
  return Float32Array.from([1 / halfWidth, 0, 0, 0, 0, 1 / halfHeight, 0, 0, 0, 0, -1 / halfDepth, 0, -x / halfWidth, -y / halfHeight, 0, 1]);
}
