// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh in typed arrays, and what the viewer needs to know of it: which cells are neighbours, and how good they are.
// Cells are tetrahedra, or triangles in the plane.

const degrees = 180 / Math.PI;

/** Corners of the faces of a tetrahedron, counterclockwise from outside; face i is opposite to corner i. */
export const FACES = [
  [1, 2, 3],
  [0, 3, 2],
  [0, 1, 3],
  [0, 2, 1],
];

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** Reads what build/pack.js has packed. */
export function decode(packed) {
  const bytes = bytesOf(packed.data);
  const arrays = {};
  for (const { name, type, offset, length } of packed.arrays) {
    const Type = { f32: Float32Array, u32: Uint32Array, u16: Uint16Array, u8: Uint8Array }[type];
    arrays[name] = new Type(bytes.buffer, offset, length);
  }
  return new Mesh(packed.dimension, arrays);
}

export class Mesh {
  /**
   * @param dimension 2 or 3
   * @param arrays positions (3 a point), cells (dimension + 1 each), subdomains (from 1); for 3D also facets (3 each)
   *   and patches (from 0); edges (2 each): on creases in space, constrained in the plane
   */
  constructor(dimension, { positions, cells, subdomains, facets, patches, edges }) {
    this.dimension = dimension;
    this.corners = dimension + 1;
    this.positions = positions;
    this.cells = cells;
    this.count = cells.length / this.corners;
    this.subdomains = subdomains;
    this.numberOfSubdomains = subdomains.reduce((most, s) => Math.max(most, s), 0);
    this.numberOfPatches = dimension === 3 ? patches.reduce((most, p) => Math.max(most, p + 1), 0) : 0;
    this.bounds = boundsOf(positions);
    this.centroids = centroidsOf(this);
    this.qualities = dimension === 3 ? smallestDihedrals(this) : smallestAngles(this);
    this.markedEdges = edgeSet(edges ?? [], positions.length / 3);
    if (dimension === 3) {
      const table = new FaceTable(this);
      this.neighbours = table.neighbours();
      this.facePatches = table.patches(facets, patches);
    }
  }

  isMarked(a, b) {
    return this.markedEdges.has(a < b ? a * this.positions.length + b : b * this.positions.length + a);
  }

  /** Number of cells whose smallest angle is below so many degrees. */
  cellsBelow(angle) {
    let count = 0;
    for (const q of this.qualities) count += q < angle;
    return count;
  }
}

function boundsOf(positions) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  const center = low.map((x, k) => (x + high[k]) / 2);
  return { low, high, center, radius: Math.hypot(...low.map((x, k) => high[k] - x)) / 2 };
}

function centroidsOf({ cells, corners, count, positions }) {
  const centroids = new Float32Array(3 * count);
  for (let c = 0; c < count; ++c)
    for (let k = 0; k < 3; ++k) {
      let sum = 0;
      for (let i = 0; i < corners; ++i) sum += positions[3 * cells[corners * c + i] + k];
      centroids[3 * c + k] = sum / corners;
    }
  return centroids;
}

function edgeSet(edges, points) {
  const set = new Set();
  for (let i = 0; i < edges.length; i += 2) {
    const [a, b] = edges[i] < edges[i + 1] ? [edges[i], edges[i + 1]] : [edges[i + 1], edges[i]];
    set.add(a * 3 * points + b);
  }
  return set;
}

// ---- Quality

/** Smallest dihedral angles of tetrahedra, in degrees. */
function smallestDihedrals({ cells, count, positions }) {
  const result = new Float32Array(count);
  const normals = new Float64Array(12);
  for (let c = 0; c < count; ++c) {
    for (let f = 0; f < 4; ++f) {
      const [i, j, k] = FACES[f];
      normalOf(positions, cells[4 * c + i], cells[4 * c + j], cells[4 * c + k], normals, 3 * f);
    }
    let cosine = -1;
    for (let f = 0; f < 4; ++f)
      for (let g = 0; g < f; ++g) {
        const dot =
          normals[3 * f] * normals[3 * g] +
          normals[3 * f + 1] * normals[3 * g + 1] +
          normals[3 * f + 2] * normals[3 * g + 2];
        if (-dot > cosine) cosine = -dot;
      }
    result[c] = Math.acos(Math.min(1, cosine)) * degrees;
  }
  return result;
}

/** Writes a unit normal. */
function normalOf(p, a, b, c, normals, at) {
  const ux = p[3 * b] - p[3 * a];
  const uy = p[3 * b + 1] - p[3 * a + 1];
  const uz = p[3 * b + 2] - p[3 * a + 2];
  const vx = p[3 * c] - p[3 * a];
  const vy = p[3 * c + 1] - p[3 * a + 1];
  const vz = p[3 * c + 2] - p[3 * a + 2];
  const x = uy * vz - uz * vy;
  const y = uz * vx - ux * vz;
  const z = ux * vy - uy * vx;
  const length = Math.sqrt(x * x + y * y + z * z) || 1;
  normals[at] = x / length;
  normals[at + 1] = y / length;
  normals[at + 2] = z / length;
}

/** Smallest angles of triangles, in degrees. */
function smallestAngles({ cells, count, positions: p }) {
  const result = new Float32Array(count);
  for (let c = 0; c < count; ++c) {
    let smallest = 180;
    for (let i = 0; i < 3; ++i) {
      const [o, a, b] = [i, (i + 1) % 3, (i + 2) % 3].map((k) => 3 * cells[3 * c + k]);
      const [ux, uy, vx, vy] = [p[a] - p[o], p[a + 1] - p[o + 1], p[b] - p[o], p[b + 1] - p[o + 1]];
      smallest = Math.min(smallest, Math.atan2(Math.abs(ux * vy - uy * vx), ux * vx + uy * vy) * degrees);
    }
    result[c] = smallest;
  }
  return result;
}

// ---- Faces

/** A hash table of the faces of tetrahedra, by their corners in rising order; open addressing in one typed array. */
class FaceTable {
  constructor(mesh) {
    this.mesh = mesh;
    this.mask = 1;
    while (this.mask < 8 * mesh.count) this.mask *= 2;
    this.slots = new Int32Array(this.mask--).fill(-1);
    this.sorted = new Uint32Array(12 * mesh.count); // corners of the faces
    for (let face = 0; face < 4 * mesh.count; ++face) {
      const [i, j, k] = FACES[face & 3];
      const first = face & ~3;
      sortInto(this.sorted, 3 * face, mesh.cells[first + i], mesh.cells[first + j], mesh.cells[first + k]);
    }
  }

  /** The slot of a face with these corners, or the free one where it would be. */
  slot(a, b, c) {
    let at = (Math.imul(a, 73856093) ^ Math.imul(b, 19349663) ^ Math.imul(c, 83492791)) & this.mask;
    for (; ; at = (at + 1) & this.mask) {
      const face = this.slots[at];
      if (face < 0) return at;
      const s = 3 * face;
      if (this.sorted[s] === a && this.sorted[s + 1] === b && this.sorted[s + 2] === c) return at;
    }
  }

  /** Of each face, 4 a cell, the cell on its other side, or -1. */
  neighbours() {
    const result = new Int32Array(4 * this.mesh.count).fill(-1);
    for (let face = 0; face < result.length; ++face) {
      const s = 3 * face;
      const at = this.slot(this.sorted[s], this.sorted[s + 1], this.sorted[s + 2]);
      const other = this.slots[at];
      if (other < 0) {
        this.slots[at] = face;
      } else {
        result[face] = other >> 2;
        result[other] = face >> 2;
      }
    }
    this.ofNeighbours = result;
    return result;
  }

  /** Of each face, 4 a cell, its patch, or -1; to be called after neighbours(). */
  patches(facets, patches) {
    const result = new Int32Array(4 * this.mesh.count).fill(-1);
    const corners = new Uint32Array(3);
    for (let f = 0; f < patches.length; ++f) {
      sortInto(corners, 0, facets[3 * f], facets[3 * f + 1], facets[3 * f + 2]);
      const face = this.slots[this.slot(corners[0], corners[1], corners[2])];
      if (face < 0) continue; // doesn't bound a cell
      result[face] = patches[f];
      const across = this.ofNeighbours[face];
      if (across < 0) continue;
      for (let i = 0; i < 4; ++i) if (this.ofNeighbours[4 * across + i] === face >> 2) result[4 * across + i] = patches[f];
    }
    return result;
  }
}

function sortInto(array, at, a, b, c) {
  const low = Math.min(a, b, c);
  const high = Math.max(a, b, c);
  array[at] = low;
  array[at + 1] = a + b + c - low - high;
  array[at + 2] = high;
}
