// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shows one or two meshes of the same domain on a canvas, under one camera and one clipping plane.

import * as THREE from "three";
import { cameraFor, fit, turn } from "./camera.js";
import { Pane } from "./pane.js";

const AXES = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

export const initialState = {
  mesher: "both", // side by side, or "weft" or "cgal"
  colour: "quality", // or "subdomain", "patch", "plain"
  edges: true,
  cut: 0, // how much of the extent is cut away, from 0 to 1
  direction: "x", // of the plane's normal: "x", "y", "z" or "view"
  flipped: false,
  below: 0, // cells with a smaller angle are highlighted, in degrees; 0: none
  glass: false, // only those cells, the others are glass
};

export class Viewer {
  /**
   * @param meshes by mesher, {weft: Mesh, cgal: Mesh}
   * @param view {up, azimuth, elevation}, see camera.js, and what else the state is to start with
   */
  constructor(canvas, meshes, view = {}) {
    this.canvas = canvas;
    this.view = view;
    this.panes = Object.entries(meshes).map(([name, mesh]) => new Pane(name, mesh));
    this.state = { ...initialState, ...view.state };
    this.mesh = this.panes[0].mesh;
    this.renderer = new THREE.WebGLRenderer({ canvas, alpha: true, antialias: true, preserveDrawingBuffer: false });
    this.renderer.setClearColor(0, 0);
    this.renderer.autoClear = false;
    this.viewNormal = [0, 0, 1];
    this.resetCamera();
    this.update();
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(canvas);
    canvas.addEventListener("keydown", (event) => this.onKey(event));
    this.resize();
  }

  resetCamera() {
    this.controls?.dispose();
    const { camera, controls } = cameraFor(this.mesh, this.canvas, this.view);
    this.camera = camera;
    this.controls = controls;
    controls.addEventListener("change", () => this.invalidate());
    this.invalidate();
  }

  /** Changes parts of the state. */
  set(changes) {
    Object.assign(this.state, changes);
    if (changes.direction === "view") this.viewNormal = this.directionToViewer();
    this.update();
  }

  update() {
    const start = performance.now();
    const plane = this.plane();
    for (const pane of this.shownPanes()) pane.update(this.state, plane);
    this.updateMilliseconds = performance.now() - start;
    this.invalidate();
  }

  shownPanes() {
    const { mesher } = this.state;
    return mesher === "both" ? this.panes : this.panes.filter((pane) => pane.name === mesher);
  }

  /** Number of triangles that are drawn. */
  get triangles() {
    return this.shownPanes().reduce((sum, pane) => sum + pane.triangles, 0);
  }

  plane() {
    const { cut, direction, flipped } = this.state;
    if (!(cut > 0) || this.mesh.dimension === 2) return null;
    const towards = direction === "view" ? this.viewNormal : AXES[direction];
    const normal = towards.map((x) => (flipped ? -x : x));
    const [least, most] = this.panes[0].extent(normal);
    return { normal, offset: most - cut * (most - least) };
  }

  directionToViewer() {
    return this.camera.position.clone().sub(this.controls.target).normalize().toArray();
  }

  // ---- Drawing

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.pixelRatio = Math.min(window.devicePixelRatio, 2);
    this.renderer.setPixelRatio(this.pixelRatio);
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.draw(); // at once, since setting the size clears the canvas
  }

  invalidate() {
    this.frame ??= requestAnimationFrame(() => {
      this.frame = null;
      this.draw();
    });
  }

  draw() {
    this.controls.update();
    const size = this.renderer.getSize(new THREE.Vector2());
    this.drawInto(size.x, size.y, this.pixelRatio);
  }

  /** Side by side, or one above the other where that leaves more room. */
  drawInto(width, height, lineWidth) {
    const panes = this.shownPanes();
    const inRow = width >= height;
    const w = inRow ? width / panes.length : width;
    const h = inRow ? height : height / panes.length;
    fit(this.camera, w / h);
    this.renderer.setScissorTest(false);
    this.renderer.clear();
    this.renderer.setScissorTest(true);
    panes.forEach((pane, i) => {
      const x = inRow ? i * w : 0;
      const y = inRow ? 0 : (panes.length - 1 - i) * h; // counted from below
      this.renderer.setViewport(x, y, w, h);
      this.renderer.setScissor(x, y, w, h);
      pane.setLineWidth(lineWidth);
      this.renderer.render(pane.scene, this.camera);
    });
  }

  /**
   * The mesh as a picture with a clear background, without moving what is on the screen.
   * @param lineWidth of edges, in pixels
   * @returns a canvas
   */
  picture(width, height, { lineWidth = 1, supersampling = 2 } = {}) {
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(supersampling * width, supersampling * height, false);
    this.drawInto(supersampling * width, supersampling * height, supersampling * lineWidth);
    const result = document.createElement("canvas");
    result.width = width;
    result.height = height;
    const context = result.getContext("2d");
    context.imageSmoothingQuality = "high";
    context.drawImage(this.canvas, 0, 0, width, height);
    this.resize();
    return result;
  }

  // ---- Keys

  onKey(event) {
    const step = Math.PI / 36;
    const keys = {
      ArrowLeft: () => turn(this, -step, 0),
      ArrowRight: () => turn(this, step, 0),
      ArrowUp: () => turn(this, 0, -step),
      ArrowDown: () => turn(this, 0, step),
      "+": () => this.zoom(1.15),
      "=": () => this.zoom(1.15),
      "-": () => this.zoom(1 / 1.15),
      0: () => this.resetCamera(),
    };
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
    this.invalidate();
  }

  zoom(factor) {
    this.camera.zoom *= factor;
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }

  dispose() {
    this.observer.disconnect();
    this.controls.dispose();
    for (const pane of this.panes) pane.dispose();
    this.renderer.dispose();
  }
}
