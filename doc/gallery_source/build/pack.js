// SPDX-License-Identifier: GPL-3.0-or-later
//
// Packs a mesh into a script that hands it to the viewer: pages from file:// can load nothing else.

/** Narrow types where they suffice: the meshes are most of what a page weighs. */
function narrow(array) {
  const most = array.reduce((m, x) => Math.max(m, x), 0);
  return most < 256 ? Uint8Array.from(array) : most < 65536 ? Uint16Array.from(array) : Uint32Array.from(array);
}

const types = new Map([
  [Float32Array, "f32"],
  [Uint32Array, "u32"],
  [Uint16Array, "u16"],
  [Uint8Array, "u8"],
]);

export function packMesh(name, { dimension, positions, ...integers }) {
  const arrays = [];
  const parts = [];
  let offset = 0;
  const append = (key, array) => {
    arrays.push({ name: key, type: types.get(array.constructor), offset, length: array.length });
    const padding = -array.byteLength & 3; // typed arrays need aligned offsets
    parts.push(Buffer.from(array.buffer, array.byteOffset, array.byteLength), Buffer.alloc(padding));
    offset += array.byteLength + padding;
  };
  append("positions", positions);
  for (const [key, array] of Object.entries(integers)) append(key, narrow(array));
  const packed = { dimension, arrays, data: Buffer.concat(parts).toString("base64") };
  return `gallery.receive(${JSON.stringify(name)}, ${JSON.stringify(packed)});\n`;
}
