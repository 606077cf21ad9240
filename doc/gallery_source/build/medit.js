// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads meshes in Medit's format, as weft writes them, into the arrays of viewer/mesh.js.

import { readFileSync } from "node:fs";

const perElement = { Vertices: null, Edges: 2, Triangles: 3, Tetrahedra: 4 };
const skipped = { Corners: 1, RequiredVertices: 1, Ridges: 1 };

/** @returns {{dimension, positions, cells, subdomains, facets, patches, edges}} */
export function readMedit(filename) {
  const words = readFileSync(filename, "latin1").split(/\s+/);
  const sections = {};
  let dimension = 0;
  for (let at = 0; at < words.length; ) {
    const word = words[at++];
    if (word === "Dimension") dimension = Number(words[at++]);
    else if (word === "MeshVersionFormatted") ++at;
    else if (word in skipped) at += 1 + Number(words[at]);
    else if (word in perElement) {
      const width = (perElement[word] ?? dimension) + 1; // a tag at the end
      const count = Number(words[at++]);
      sections[word] = { width, count, values: words.slice(at, at + width * count).map(Number) };
      at += width * count;
    } else if (word !== "End" && word !== "") throw new Error(`${filename}: '${word}' isn't expected`);
  }
  return arraysOf(dimension, sections, filename);
}

function arraysOf(dimension, { Vertices, Edges, Triangles, Tetrahedra }, filename) {
  const cells = dimension === 3 ? Tetrahedra : Triangles;
  if (!Vertices || !cells || cells.count === 0) throw new Error(`${filename}: there are no cells`);
  const positions = new Float32Array(3 * Vertices.count);
  for (let v = 0; v < Vertices.count; ++v)
    for (let k = 0; k < dimension; ++k) positions[3 * v + k] = Vertices.values[Vertices.width * v + k];
  const facets = dimension === 3 ? Triangles : undefined;
  return {
    dimension,
    positions,
    cells: corners(cells),
    subdomains: tags(cells, 0),
    facets: corners(facets),
    patches: tags(facets, 1),
    edges: corners(Edges),
  };
}

/** Corners of all elements, from 0. */
function corners(section) {
  if (!section) return new Uint32Array(0);
  const { width, count, values } = section;
  const result = new Uint32Array((width - 1) * count);
  for (let i = 0, to = 0; i < count; ++i)
    for (let k = 0; k < width - 1; ++k) result[to++] = values[width * i + k] - 1;
  return result;
}

/** Tags of all elements, numbered anew without gaps, in rising order, if there are too many for a byte or two. */
function tags(section, first) {
  if (!section) return new Uint16Array(0);
  const { width, count, values } = section;
  return Uint16Array.from({ length: count }, (_, i) => values[width * i + width - 1] - first);
}
