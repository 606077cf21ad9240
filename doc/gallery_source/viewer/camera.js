// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cameras: in space one that goes around the mesh, in the plane one that is moved over it.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const fieldOfView = 30; // degrees

/**
 * @param view in space: which axis points up, and from where the mesh is seen, as azimuth and elevation in degrees;
 *   zoom
 */
export function cameraFor(mesh, canvas, view) {
  return mesh.dimension === 2 ? planarCamera(mesh, canvas, view) : spatialCamera(mesh, canvas, view);
}

function spatialCamera(mesh, canvas, { up = "z", azimuth = 30, elevation = 20, zoom = 1 }) {
  const { center, radius } = mesh.bounds;
  const camera = new THREE.PerspectiveCamera(fieldOfView, 1, radius / 20, 20 * radius);
  camera.zoom = zoom;
  camera.up.set(0, up === "y" ? 1 : 0, up === "z" ? 1 : 0);
  const [a, e] = [azimuth, elevation].map((x) => (x * Math.PI) / 180);
  const [forward, side, height] = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
  const direction = up === "z" ? [forward, side, height] : [side, height, forward];
  const distance = (1.02 * radius) / Math.sin((fieldOfView / 2) * (Math.PI / 180));
  camera.position.set(...center.map((x, k) => x + distance * direction[k]));
  const controls = new OrbitControls(camera, canvas);
  controls.target.set(...center);
  controls.minDistance = 0.2 * radius;
  controls.maxDistance = 15 * radius;
  controls.enableDamping = true;
  controls.dampingFactor = 0.15;
  controls.update();
  camera.userData.half = halfAngles(mesh, camera);
  return { camera, controls };
}

/** Tangents of half the angles under which the camera sees the mesh, across and upright. */
function halfAngles({ positions, bounds }, camera) {
  camera.updateMatrixWorld();
  const point = new THREE.Vector3();
  const half = [0, 0];
  for (let i = 0; i < positions.length; i += 3) {
    point.fromArray(positions, i).applyMatrix4(camera.matrixWorldInverse);
    half[0] = Math.max(half[0], Math.abs(point.x / point.z));
    half[1] = Math.max(half[1], Math.abs(point.y / point.z));
  }
  // Of a flat body, not so little that turning it would bring much of it out of sight.
  const least = (0.6 * bounds.radius) / camera.position.distanceTo(point.fromArray(bounds.center));
  return half.map((x) => 1.06 * Math.max(x, least));
}

function planarCamera(mesh, canvas, { zoom = 1 }) {
  const { low, high, center, radius } = mesh.bounds;
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 10);
  camera.zoom = zoom;
  camera.userData.half = [1.03 * Math.max((high[0] - low[0]) / 2, 1e-9 * radius), 1.03 * ((high[1] - low[1]) / 2)];
  camera.position.set(center[0], center[1], 5);
  const controls = new OrbitControls(camera, canvas);
  controls.target.set(center[0], center[1], 0);
  controls.enableRotate = false;
  controls.zoomToCursor = true;
  controls.minZoom = 0.5;
  controls.maxZoom = 200;
  controls.mouseButtons.LEFT = THREE.MOUSE.PAN;
  controls.touches = { ONE: THREE.TOUCH.PAN, TWO: THREE.TOUCH.DOLLY_PAN };
  controls.update();
  return { camera, controls };
}

/** Lets the whole mesh be seen in a window of that width over height. */
export function fit(camera, aspect) {
  const [x, y] = camera.userData.half;
  const height = Math.max(y, x / aspect);
  if (camera.isPerspectiveCamera) {
    camera.fov = (2 * Math.atan(height) * 180) / Math.PI;
    camera.aspect = aspect;
  } else {
    camera.top = height;
    camera.bottom = -height;
    camera.right = height * aspect;
    camera.left = -camera.right;
  }
  camera.updateProjectionMatrix();
}

/** Turns the camera around the mesh, or moves it over the plane, by angles as if the mesh was dragged. */
export function turn({ camera, controls }, right, down) {
  if (!camera.isPerspectiveCamera) {
    const step = (camera.top - camera.bottom) / camera.zoom / 2;
    const move = new THREE.Vector3(right * step, -down * step, 0);
    camera.position.add(move);
    controls.target.add(move);
    controls.update();
    return;
  }
  const offset = camera.position.clone().sub(controls.target);
  const polar = offset.angleTo(camera.up);
  const side = new THREE.Vector3().crossVectors(camera.up, offset).normalize();
  const tilt = Math.min(Math.max(polar + down, 0.02), Math.PI - 0.02) - polar;
  offset.applyAxisAngle(side, tilt).applyAxisAngle(camera.up, right);
  camera.position.copy(controls.target).add(offset);
  controls.update();
}
