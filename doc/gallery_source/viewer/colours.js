// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colours of cells and faces, as [red, green, blue] from 0 to 255.

/** From bad to good: told apart with any kind of colour vision. */
const SCALE = [
  [165, 15, 38],
  [222, 78, 56],
  [247, 148, 86],
  [253, 212, 136],
  [222, 234, 204],
  [164, 208, 222],
  [117, 176, 211],
  [82, 143, 194],
  [56, 112, 173],
];

const CATEGORIES = [
  [91, 141, 199],
  [230, 147, 72],
  [116, 178, 106],
  [201, 105, 117],
  [142, 124, 195],
  [191, 168, 92],
  [92, 178, 178],
  [196, 134, 178],
];

/** Boundary faces beside cells that are coloured by quality. */
export const PLAIN = [203, 208, 215];
/** Cells below the angle that is looked for. */
export const HIGHLIGHT = [214, 40, 40];

/** Largest smallest angle that there is: of a regular tetrahedron, or triangle. */
export const bestAngle = (dimension) => (dimension === 3 ? 70.53 : 60);

/** The top of the colour scale, in degrees. */
export const SCALE_TOP = 60;

const steps = Array.from({ length: 256 }, (_, i) => {
  const at = (i / 255) * (SCALE.length - 1);
  const low = Math.min(Math.floor(at), SCALE.length - 2);
  return SCALE[low].map((x, k) => Math.round(x + (at - low) * (SCALE[low + 1][k] - x)));
});

export function colourOfAngle(angle) {
  return steps[Math.max(0, Math.min(255, Math.round((255 * angle) / SCALE_TOP)))];
}

/** Colours repeat, in lighter tones, after eight. */
const categories = Array.from({ length: 256 }, (_, i) => {
  const lighter = (Math.floor(i / CATEGORIES.length) % 3) * 0.25;
  return CATEGORIES[i % CATEGORIES.length].map((x) => Math.round(x + lighter * (255 - x)));
});

export const colourOfCategory = (i) => categories[i & 255];

/** The scale as a CSS gradient. */
export const scaleGradient = `linear-gradient(to right, ${SCALE.map((c) => `rgb(${c.join(" ")})`).join(", ")})`;

/**
 * The colouring that a state of the viewer asks for, as fillVisible() takes it.
 * @param state see viewer.js
 * @param isCut whether a part of the mesh is cut away; if not, qualities are shown on the boundary
 */
export function colouring(mesh, state, isCut) {
  const { qualities, subdomains } = mesh;
  const base = {
    quality: (c, f, isBared) => (f >= 0 && isCut && !isBared ? PLAIN : colourOfAngle(qualities[c])),
    subdomain: (c) => colourOfCategory(subdomains[c] - 1),
    patch: (c, f) => {
      const patch = f < 0 ? -1 : mesh.facePatches[4 * c + f];
      return patch < 0 ? PLAIN : colourOfCategory(patch);
    },
    plain: () => PLAIN,
  }[state.colour];
  if (!(state.below > 0)) return base;
  return (c, f, isBared) => (qualities[c] < state.below ? HIGHLIGHT : pale(base(c, f, isBared)));
}

/** Towards the plain colour, so that what is highlighted stands out. */
function pale(colour) {
  return colour.map((x, k) => Math.round(0.25 * x + 0.75 * PLAIN[k]));
}
