// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which triangles are to be drawn: the faces of the cells that a plane leaves, whole cells, where no other such cell
// hides them. Everything is written into typed arrays that are used again, so that cutting keeps up with a slider.

import { FACES } from "./mesh.js";

/** Triangles to draw: 9 coordinates, and 3 times red, green, blue, marks; marks tell thick edges, see material.js. */
export class TriangleBuffer {
  constructor(capacity = 1024) {
    this.count = 0;
    this.allocate(capacity);
  }

  allocate(capacity) {
    const { positions, colours } = this;
    this.capacity = capacity;
    this.positions = new Float32Array(9 * capacity);
    this.colours = new Uint8Array(12 * capacity);
    if (!positions) return;
    this.positions.set(positions);
    this.colours.set(colours);
  }

  add(mesh, a, b, c, colour) {
    if (this.count === this.capacity) this.allocate(2 * this.capacity);
    const from = mesh.positions;
    const to = this.positions;
    const p = 9 * this.count;
    for (let k = 0; k < 3; ++k) {
      to[p + k] = from[3 * a + k];
      to[p + 3 + k] = from[3 * b + k];
      to[p + 6 + k] = from[3 * c + k];
    }
    // Edge i is opposite to corner i.
    const marks =
      mesh.markedEdges.size === 0 ? 0 : mesh.isMarked(b, c) | (mesh.isMarked(c, a) << 1) | (mesh.isMarked(a, b) << 2);
    for (let i = 0, q = 12 * this.count; i < 3; ++i, q += 4) {
      this.colours[q] = colour[0];
      this.colours[q + 1] = colour[1];
      this.colours[q + 2] = colour[2];
      this.colours[q + 3] = marks;
    }
    ++this.count;
  }
}

/** Marks the cells whose centroids lie on the kept side of a plane: normal . x <= offset. Without a plane, all. */
export function keepCells(mesh, plane, kept) {
  if (!plane) return kept.fill(1);
  const [x, y, z] = plane.normal;
  const c = mesh.centroids;
  for (let i = 0; i < mesh.count; ++i)
    kept[i] = x * c[3 * i] + y * c[3 * i + 1] + z * c[3 * i + 2] <= plane.offset ? 1 : 0;
  return kept;
}

/**
 * Fills the buffer with the visible faces of the kept cells; of planar meshes, with the kept triangles.
 * @param colourOf (cell, face or -1, whether the face was bared by cutting) -> [red, green, blue] or null to leave it out
 */
export function fillVisible(mesh, kept, colourOf, buffer) {
  buffer.count = 0;
  const { cells } = mesh;
  if (mesh.dimension === 2) {
    for (let c = 0; c < mesh.count; ++c)
      if (kept[c]) buffer.add(mesh, cells[3 * c], cells[3 * c + 1], cells[3 * c + 2], colourOf(c, -1, false));
    return buffer;
  }
  for (let c = 0; c < mesh.count; ++c) {
    if (!kept[c]) continue;
    for (let f = 0; f < 4; ++f) {
      const across = mesh.neighbours[4 * c + f];
      if (across >= 0 && kept[across]) continue;
      const colour = colourOf(c, f, across >= 0 && mesh.subdomains[across] === mesh.subdomains[c]);
      if (!colour) continue;
      const [i, j, k] = FACES[f];
      buffer.add(mesh, cells[4 * c + i], cells[4 * c + j], cells[4 * c + k], colour);
    }
  }
  return buffer;
}
