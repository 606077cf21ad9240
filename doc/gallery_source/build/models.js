// SPDX-License-Identifier: GPL-3.0-or-later
//
// The models of the gallery, how they are meshed and from where they are seen.
//
// arguments: of gallery_planar or gallery_spatial (benchmark/). file: among the models of Debian's package
// libcgal-demo. view: see viewer/camera.js; its state, of the viewer, is that of the cut-away picture.

const planarAbout = {
  square: "The plainest of domains. A mesher can only lose here.",
  circle: "A regular polygon of 48 corners.",
  comb: "Twelve teeth; the gaps between them are a fifth of a tooth wide.",
  parallel: "Two constraints inside a square, a fiftieth of its side apart.",
  star: "Seventeen spikes, whose tips have angles of 5 to 37 degrees: no mesh has larger ones there.",
  "nested holes": "A disk with a hole, in it an island, and a hole in that.",
  "smooth curve": "A smooth closed curve of 256 points.",
  coastline: "A fractal shore of 1280 segments and 60 rough islands, most of them much finer than the triangles.",
  airfoil: "The NACA 2412 profile in a box.",
  "gulf.poly": "A gulf with nine islands; the coast is finer than most of the water needs.",
  "airfoil.poly": "A NACA 0012 section, 4° nose up, in a channel.",
  "plate.poly": "A mounting plate with a bore, bolt holes and slots; the seat around the bore and four ribs are constraints inside.",
};

/** Triangles asked for, where they aren't 3000. */
const triangles = { coastline: 6000, "gulf.poly": 4000, comb: 2500, square: 1500, circle: 1500, parallel: 2000 };

/** Names of files that would be those of other inputs. */
const titles = { "airfoil.poly": "airfoil in a channel" };

const idOf = (title) => title.replaceAll(" ", "_");

function planar(name) {
  const title = titles[name] ?? name.replace(".poly", "");
  const isLinear = name === "square" || name === "circle";
  const number = String(triangles[name] ?? 3000);
  return {
    id: idOf(title),
    title,
    dimension: 2,
    about: planarAbout[name],
    input: name,
    variants: [
      { id: "uniform", title: "Uniform", about: "The same size everywhere.", arguments: ["--triangles", number] },
      {
        id: "graded",
        title: "Graded",
        about: isLinear ? "The size grows with the distance from a point." : "The size follows the local feature size.",
        arguments: ["--triangles", number, "--field", isLinear ? "linear" : "lfs"],
      },
    ],
  };
}

const cutAway = (state, view = {}) => ({ ...view, state });

function spatial(title, about, options) {
  const { input, file, bounds = [0.1, 0.001], sharp = 0, view } = options;
  return {
    id: idOf(title),
    title,
    dimension: 3,
    about,
    input,
    file,
    variants: [
      {
        id: "mesh",
        view,
        arguments: ["--size", String(bounds[0]), "--approximation", String(bounds[1]), "--sharp-angle", String(sharp)],
      },
    ],
  };
}

export const models = [
  spatial("gear", "A spur gear with hub, bore and fillets.", {
    input: "gear.off",
    bounds: [0.05, 0.0008],
    sharp: 60,
    view: cutAway({ cut: 0.42, direction: "y", flipped: true }, { azimuth: -70, elevation: 38 }),
  }),
  spatial("sphere", "A uniform size, and nothing but it.", {
    input: "sphere",
    bounds: [0.08, 0],
    view: cutAway({ cut: 0.45, direction: "x" }, { azimuth: 25, elevation: 22 }),
  }),
  spatial("nested spheres", "A ball with a concentric cavity.", {
    input: "nested spheres",
    bounds: [0.08, 0],
    view: cutAway({ cut: 0.48, direction: "x" }, { azimuth: 28, elevation: 22 }),
  }),
  spatial("cylinder", "Two circular creases.", {
    input: "cylinder",
    sharp: 60,
    view: cutAway({ cut: 0.45, direction: "x" }, { azimuth: 30, elevation: 18 }),
  }),
  spatial("three materials", "A ball of three materials that a function tells apart. The interfaces are meshed, too.", {
    input: "three materials",
    bounds: [0.1, 0.005],
    view: cutAway({ cut: 0.4, direction: "z", colour: "subdomain" }, { azimuth: 20, elevation: 48 }),
  }),
  spatial("elephant", "The classic of CGAL's manual.", {
    file: "meshes/elephant.off",
    view: cutAway({ cut: 0.36, direction: "z" }, { up: "y", azimuth: 22, elevation: 10 }),
  }),
  spatial("dino", "Thin legs and a long tail.", {
    file: "meshes/dino.off",
    view: cutAway({ cut: 0.5, direction: "x" }, { up: "z", azimuth: 18, elevation: 10 }),
  }),
  spatial("bunny", "A scan, smooth but for its noise.", {
    file: "meshes/bunny00.off",
    view: cutAway({ cut: 0.5, direction: "z" }, { up: "y", azimuth: 20, elevation: 12 }),
  }),
  spatial("homer", "A figure with thin parts.", {
    file: "meshes/homer.off",
    view: cutAway({ cut: 0.48, direction: "z" }, { up: "y", azimuth: 22, elevation: 8 }),
  }),
  spatial("bear", "A rounded figure.", {
    file: "meshes/bear.off",
    view: cutAway({ cut: 0.48, direction: "z" }, { up: "y", azimuth: 22, elevation: 8 }),
  }),
  spatial("armadillo", "Detail everywhere.", {
    file: "meshes/armadillo.off",
    view: cutAway({ cut: 0.5, direction: "z", flipped: true }, { up: "y", azimuth: 202, elevation: 8 }),
  }),
  spatial("anchor", "A mechanical part with curved and sharp edges.", {
    file: "meshes/anchor.off",
    sharp: 60,
    view: cutAway({ cut: 0.45, direction: "y" }, { up: "y", azimuth: 35, elevation: 32 }),
  }),
  spatial("anchor dense", "The same part, its surface with many more triangles.", {
    file: "meshes/anchor_dense.off",
    sharp: 60,
    view: cutAway({ cut: 0.45, direction: "y" }, { up: "y", azimuth: 35, elevation: 32 }),
  }),
  spatial("fandisk", "Smooth patches that meet in creases, some of which fade out.", {
    file: "meshes/fandisk.off",
    sharp: 60,
    view: cutAway({ cut: 0.45, direction: "x" }, { up: "z", azimuth: 35, elevation: 25 }),
  }),
  spatial("turbine", "Creases close to each other.", {
    file: "meshes/turbine.off",
    sharp: 60,
    view: cutAway({ cut: 0.5, direction: "y" }, { up: "y", azimuth: 60, elevation: 32 }),
  }),
  spatial("dragknob", "A knob with many small fillets.", {
    file: "meshes/dragknob.off",
    sharp: 60,
    view: cutAway({ cut: 0.5, direction: "y" }, { up: "y", azimuth: 60, elevation: 32 }),
  }),
  spatial("joint", "Bores that cross.", {
    file: "meshes/joint.off",
    sharp: 60,
    view: cutAway({ cut: 0.45, direction: "x" }, { up: "z", azimuth: 35, elevation: 25 }),
  }),
  spatial("liver", "A segmented scan of several tissues, meshed straight from its voxels.", {
    file: "images/liver.inr.gz",
    bounds: [0.05, 0.004],
    view: cutAway({ cut: 0.45, direction: "z", colour: "subdomain" }, { azimuth: -60, elevation: 40 }),
  }),
  ...Object.keys(planarAbout).map(planar),
];

/** Those of the gallery that --quick makes. */
export const quick = ["square", "gulf", "gear", "sphere"];
