// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cutting, tested on a grid of cubes of six tetrahedra each. Needs Node.js alone: node --test test/cut.test.js

import assert from "node:assert/strict";
import test from "node:test";
import { fillVisible, keepCells, TriangleBuffer } from "../viewer/cut.js";
import { Mesh } from "../viewer/mesh.js";

/** n^3 cubes; the tetrahedra of each go around a diagonal. */
function grid(n) {
  const at = (x, y, z) => (z * (n + 1) + y) * (n + 1) + x;
  const positions = new Float32Array(3 * (n + 1) ** 3);
  for (let z = 0; z <= n; ++z)
    for (let y = 0; y <= n; ++y) for (let x = 0; x <= n; ++x) positions.set([x / n, y / n, z / n], 3 * at(x, y, z));
  const ways = [
    [0, 1, 2],
    [1, 2, 0],
    [2, 0, 1],
    [0, 2, 1],
    [2, 1, 0],
    [1, 0, 2],
  ];
  const cells = [];
  for (let z = 0; z < n; ++z)
    for (let y = 0; y < n; ++y)
      for (let x = 0; x < n; ++x)
        ways.forEach((way, i) => {
          const place = [x, y, z];
          const path = [at(...place)];
          for (const axis of way) {
            ++place[axis];
            path.push(at(...place));
          }
          if (i >= 3) [path[2], path[3]] = [path[3], path[2]]; // positively oriented
          cells.push(...path);
        });
  const count = cells.length / 4;
  return new Mesh(3, {
    positions,
    cells: Uint32Array.from(cells),
    subdomains: new Uint8Array(count).fill(1),
    facets: new Uint32Array(0),
    patches: new Uint16Array(0),
    edges: new Uint32Array(0),
  });
}

const grey = () => [128, 128, 128];

function visible(mesh, plane) {
  const kept = keepCells(mesh, plane, new Uint8Array(mesh.count));
  return { kept, buffer: fillVisible(mesh, kept, grey, new TriangleBuffer(1)) };
}

/** Six times the volume that the triangles bound. */
function sixVolumes({ positions, count }) {
  let sum = 0;
  for (let t = 0; t < count; ++t) {
    const [a, b, c] = [0, 3, 6].map((i) => positions.subarray(9 * t + i, 9 * t + i + 3));
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

test("the whole mesh shows its boundary and nothing else", () => {
  const n = 5;
  const { buffer } = visible(grid(n), null);
  assert.equal(buffer.count, 6 * 2 * n * n);
  assert.ok(Math.abs(sixVolumes(buffer) - 6) < 1e-4);
});

test("what a plane leaves is the closed surface of the cells that are kept", () => {
  const mesh = grid(6);
  for (const normal of [[1, 0, 0], [0, -1, 0], [0.6, 0.48, 0.64]]) {
    const { kept, buffer } = visible(mesh, { normal, offset: 0.37 * normal.reduce((a, b) => a + b) });
    const cells = kept.reduce((a, b) => a + b);
    assert.ok(cells > 0 && cells < mesh.count);
    assert.ok(Math.abs(sixVolumes(buffer) - cells / 6 ** 3) < 1e-4, "six volumes of a cell are a cube");
  }
});

test("a plane beyond the mesh takes all or nothing", () => {
  const mesh = grid(2);
  assert.equal(visible(mesh, { normal: [1, 0, 0], offset: -1 }).buffer.count, 0);
  assert.equal(visible(mesh, { normal: [1, 0, 0], offset: 2 }).buffer.count, visible(mesh, null).buffer.count);
});

test("dihedral angles are those of the cells", () => {
  const mesh = grid(2);
  for (const q of mesh.qualities) assert.ok(Math.abs(q - 45) < 1e-3);
  assert.equal(mesh.cellsBelow(46), mesh.count);
  assert.equal(mesh.cellsBelow(44), 0);
});

test("100,000 cells are cut within 50 ms", () => {
  const mesh = grid(26);
  assert.ok(mesh.count > 100000);
  const kept = new Uint8Array(mesh.count);
  const buffer = new TriangleBuffer();
  const times = [];
  for (let i = 0; i < 15; ++i) {
    const start = performance.now();
    keepCells(mesh, { normal: [0.6, 0, 0.8], offset: 0.1 * i }, kept);
    fillVisible(mesh, kept, grey, buffer);
    times.push(performance.now() - start);
  }
  const median = times.sort((a, b) => a - b)[7];
  console.log(`cut of ${mesh.count} cells: median ${median.toFixed(1)} ms`);
  assert.ok(median < 50);
});
