// SPDX-License-Identifier: GPL-3.0-or-later
//
// How triangles are drawn: flat, lit from beside the viewer, their edges as antialiased lines of constant width. The
// triangles aren't indexed, so a corner's number modulo 3 gives its barycentric coordinates. The fourth component of a
// colour has a bit for each edge that is drawn thick (creases, constraints).

import * as THREE from "three";

const vertexShader = /* glsl */ `
  in vec4 colour;
  out vec3 tint;
  out vec3 place;
  out vec3 corner;
  flat out vec3 thick;
  void main() {
    int i = gl_VertexID % 3;
    corner = vec3(i == 0, i == 1, i == 2);
    int marks = int(colour.a + 0.5);
    thick = vec3(marks & 1, (marks >> 1) & 1, (marks >> 2) & 1);
    tint = pow(colour.rgb / 255.0, vec3(2.2));
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    place = seen.xyz;
    gl_Position = projectionMatrix * seen;
  }
`;

const common = /* glsl */ `
  in vec3 tint;
  in vec3 place;
  in vec3 corner;
  flat in vec3 thick;
  out vec4 result;
  uniform float edges;
  uniform float lineWidth;
  uniform bool isFlat;

  // How far a pixel is covered by the lines of the edges.
  float line() {
    vec3 pixels = corner / fwidth(corner);
    vec3 width = lineWidth * (0.5 + 0.75 * thick);
    vec3 cover = 1.0 - smoothstep(width - 0.5, width + 0.5, pixels);
    vec3 wanted = max(thick, vec3(edges));
    cover *= wanted;
    return max(cover.x, max(cover.y, cover.z));
  }

  vec3 faceNormal() {
    vec3 n = normalize(cross(dFdx(place), dFdy(place)));
    return n.z < 0.0 ? -n : n;
  }
`;

const solidShader = /* glsl */ `
  ${common}
  void main() {
    vec3 light = vec3(1.0);
    if (!isFlat) {
      vec3 n = faceNormal();
      vec3 toViewer = normalize(-place);
      vec3 key = normalize(vec3(-0.45, 0.75, 0.85));
      float diffuse = max(dot(n, key), 0.0);
      float fill = max(dot(n, normalize(vec3(0.8, -0.1, 0.5))), 0.0);
      float sky = 0.5 + 0.5 * n.y;
      float gloss = pow(max(dot(n, normalize(key + toViewer)), 0.0), 32.0);
      light = vec3(0.20 + 0.16 * sky) + vec3(1.0, 0.98, 0.95) * 0.68 * diffuse + vec3(0.85, 0.92, 1.0) * 0.20 * fill;
      light += 0.05 * gloss;
    }
    vec3 shade = tint * light;
    shade = mix(shade, shade * 0.10, line() * 0.72);
    result = vec4(pow(clamp(shade, 0.0, 1.0), vec3(1.0 / 2.2)), 1.0);
  }
`;

// Nearly clear where it faces the viewer, denser towards the silhouette.
const glassShader = /* glsl */ `
  ${common}
  uniform vec3 glass;
  void main() {
    float facing = abs(dot(faceNormal(), normalize(-place)));
    float rim = pow(1.0 - facing, 2.5);
    float alpha = 0.05 + 0.35 * rim + 0.13 * line();
    result = vec4(glass * alpha, alpha);
  }
`;

function material(fragmentShader, uniforms, options) {
  return new THREE.ShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader,
    fragmentShader,
    uniforms: { edges: { value: 1 }, lineWidth: { value: 1 }, isFlat: { value: false }, ...uniforms },
    side: THREE.DoubleSide,
    ...options,
  });
}

export const solidMaterial = () => material(solidShader, {}, {});

export const glassMaterial = () =>
  material(
    glassShader,
    { glass: { value: new THREE.Vector3(0.45, 0.53, 0.62) } },
    { transparent: true, depthWrite: false, premultipliedAlpha: true, blending: THREE.NormalBlending },
  );
