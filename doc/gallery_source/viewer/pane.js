// SPDX-License-Identifier: GPL-3.0-or-later
//
// One mesh on the screen: its triangles as three.js objects, made anew when the state changes.

import * as THREE from "three";
import { colouring, HIGHLIGHT } from "./colours.js";
import { fillVisible, keepCells, TriangleBuffer } from "./cut.js";
import { glassMaterial, solidMaterial } from "./material.js";

/** Triangles of a buffer as an object of a scene. */
class Drawn {
  constructor(material) {
    this.buffer = new TriangleBuffer();
    this.object = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.object.frustumCulled = false;
  }

  update() {
    const { buffer, object } = this;
    const { geometry } = object;
    if (geometry.getAttribute("position")?.array !== buffer.positions) {
      geometry.dispose(); // the buffer has grown
      geometry.setAttribute("position", new THREE.BufferAttribute(buffer.positions, 3));
      geometry.setAttribute("colour", new THREE.BufferAttribute(buffer.colours, 4));
    }
    geometry.setDrawRange(0, 3 * buffer.count);
    for (const [name, size] of [["position", 9], ["colour", 12]]) {
      const attribute = geometry.getAttribute(name);
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, size * buffer.count);
      attribute.needsUpdate = true;
    }
    object.visible = buffer.count > 0;
  }
}

export class Pane {
  constructor(name, mesh) {
    this.name = name;
    this.mesh = mesh;
    this.kept = new Uint8Array(mesh.count);
    this.inside = new Uint8Array(mesh.count); // cells to be seen through the glass
    this.solid = new Drawn(solidMaterial());
    this.glass = new Drawn(glassMaterial());
    this.scene = new THREE.Scene();
    this.scene.add(this.solid.object, this.glass.object);
    this.solid.object.material.uniforms.isFlat.value = mesh.dimension === 2;
  }

  get triangles() {
    return this.solid.buffer.count + this.glass.buffer.count;
  }

  /** How far the mesh reaches along a direction, as [least, most]. */
  extent([x, y, z]) {
    const p = this.mesh.positions;
    let least = Infinity;
    let most = -Infinity;
    for (let i = 0; i < p.length; i += 3) {
      const at = x * p[i] + y * p[i + 1] + z * p[i + 2];
      if (at < least) least = at;
      if (at > most) most = at;
    }
    return [least, most];
  }

  /** @param plane {normal, offset}, or null */
  update(state, plane) {
    const { mesh, kept, inside, solid, glass } = this;
    keepCells(mesh, plane, kept);
    const asGlass = state.glass && mesh.dimension === 3;
    if (asGlass) {
      for (let c = 0; c < mesh.count; ++c) inside[c] = kept[c] && mesh.qualities[c] < state.below ? 1 : 0;
      fillVisible(mesh, inside, () => HIGHLIGHT, solid.buffer);
      fillVisible(mesh, kept, () => HIGHLIGHT, glass.buffer);
    } else {
      fillVisible(mesh, kept, colouring(mesh, state, plane !== null), solid.buffer);
      glass.buffer.count = 0;
    }
    solid.update();
    glass.update();
    for (const { object } of [solid, glass]) object.material.uniforms.edges.value = state.edges ? 1 : 0;
  }

  setLineWidth(pixels) {
    for (const { object } of [this.solid, this.glass]) object.material.uniforms.lineWidth.value = pixels;
  }

  dispose() {
    for (const { object } of [this.solid, this.glass]) {
      object.geometry.dispose();
      object.material.dispose();
    }
  }
}
