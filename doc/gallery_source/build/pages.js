// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pages as text: one with a card for each model, and one for each model.

import { SCALE_TOP, scaleGradient } from "../viewer/colours.js";
import { histogram } from "./histogram.js";

export const escape = (text) =>
  text.replace(/[&<>"']/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&#39;" })[c]);

const integer = (n) => n.toLocaleString("en");
const degrees = (x) => `${x.toFixed(1)}°`;
const seconds = (s) => `${s.toPrecision(s < 10 ? 2 : 3)} s`;
const capital = (text) => text[0].toUpperCase() + text.slice(1);

const row = (variant, mesher) => variant.figures.meshes.find((mesh) => mesh.mesher === mesher);

/** Sums of the histograms below a whole degree. */
const below = (mesh, angle) => mesh.smallest_angles.slice(0, angle).reduce((a, b) => a + b, 0);

// ---- Frame

function page({ title, root, script, body }) {
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>${escape(title)}</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="${root}gallery.css">
</head>
<body>
${body}
${script ? `<script src="${root}viewer.js"></script>\n` : ""}</body>
</html>
`;
}

// ---- Landing page

function card(model) {
  const [variant] = model.variants;
  const [weft, cgal] = [row(variant, "weft"), row(variant, "CGAL")];
  return `<li class="card">
<a href="models/${model.id}.html">
<img src="pictures/${model.id}_${variant.id}_${model.dimension === 3 ? "cut_" : ""}weft.webp" alt="" width="640" height="480" loading="lazy">
<h3>${escape(capital(model.title))}</h3>
<p>${integer(weft.elements)} ${model.dimension === 3 ? "tetrahedra" : "triangles"}<br>
angles from <b>${degrees(weft.smallest_angle)}</b> <span class="quiet">(CGAL ${degrees(cgal.smallest_angle)})</span></p>
</a>
</li>`;
}

const scale = `<div class="scale">
<div class="gradient" style="background: ${scaleGradient}"></div>
<div class="ticks">${[0, 20, 40, SCALE_TOP].map((x) => `<span>${x}°</span>`).join("")}</div>
</div>`;

function section(id, title, about, models) {
  if (models.length === 0) return "";
  return `<section aria-labelledby="${id}">
<h2 id="${id}">${title}</h2>
<div class="legend">
<p class="lead">${about}</p>
${scale}
</div>
<ul class="cards">
${models.map(card).join("\n")}
</ul>
</section>`;
}

function overviewRow(model, variant) {
  const [weft, cgal] = [row(variant, "weft"), row(variant, "CGAL")];
  const name = model.variants.length > 1 ? `${model.title}, ${variant.title.toLowerCase()}` : model.title;
  return `<tr><th scope="row"><a href="models/${model.id}.html">${escape(capital(name))}</a></th>
<td>${integer(weft.vertices)}</td><td>${integer(cgal.vertices)}</td><td>${degrees(weft.smallest_angle)}</td><td>${degrees(cgal.smallest_angle)}</td><td>${degrees(weft.largest_angle)}</td><td>${degrees(cgal.largest_angle)}</td><td>${seconds(weft.seconds)}</td><td>${seconds(cgal.seconds)}</td></tr>`;
}

function overview(models) {
  return `<section aria-labelledby="numbers">
<h2 id="numbers">In numbers</h2>
<div class="scroller" tabindex="0" role="region" aria-label="All models in numbers">
<table class="figures">
<thead><tr><th rowspan="2" scope="col">Model</th><th colspan="2" scope="colgroup">Vertices</th><th colspan="2" scope="colgroup">Smallest angle</th><th colspan="2" scope="colgroup">Largest angle</th><th colspan="2" scope="colgroup">User time</th></tr>
<tr>${"<th scope='col'>weft</th><th scope='col'>CGAL</th>".repeat(4)}</tr></thead>
<tbody>
${models.flatMap((model) => model.variants.map((variant) => overviewRow(model, variant))).join("\n")}
</tbody>
</table>
</div>
<p class="note">Angles of triangles in the plane, dihedral angles of tetrahedra in space. CGAL in the plane:
<code>refine_Delaunay_mesh_2</code>; in space: <code>make_mesh_3</code> with its defaults, that is refinement,
perturbation and exudation. Where CGAL has fewer vertices in space, its edges are longer than asked; the pages of the
models say by how much.</p>
</section>`;
}

export function landingPage({ models, missing, about }) {
  const planar = models.filter((model) => model.dimension === 2);
  const spatial = models.filter((model) => model.dimension === 3);
  const skipped =
    missing.length === 0
      ? ""
      : `<p class="note skipped">Left out, since their files weren't found: ${missing.map((m) => escape(m.title)).join(", ")}.
They are in Debian's package <code>libcgal-demo</code>.</p>`;
  return page({
    title: "weft: gallery",
    root: "",
    body: `<header class="hero">
<p class="brand">weft</p>
<h1>Gallery</h1>
<p class="lead">Meshes by weft beside CGAL's of the same sizes and bounds. Open a model to turn it, cut it open, and look
for its worst cells.</p>
</header>
<main>
${section("spatial", "In space", "Tetrahedra, cut open and coloured by their smallest dihedral angle, unless there are several materials.", spatial)}
${section("planar", "In the plane", "Triangles, coloured by their smallest angle.", planar)}
${overview([...spatial, ...planar])}
${skipped}
</main>
<footer><p>${escape(about)}</p></footer>`,
  });
}

// ---- Page of a model

function poster(model, variant) {
  const size = Math.round(Object.values(variant.bytes).reduce((a, b) => a + b, 0) / 1024);
  const label = size < 1024 ? `${size} kB` : `${(size / 1024).toFixed(1)} MB`;
  return `<div class="poster">
<img src="../pictures/${model.id}_${variant.id}_both.webp" alt="${escape(`${model.title}: meshes by weft, left, and CGAL, right`)}" width="1440" height="720">
<button type="button">Open the viewer <small>${label}</small></button>
</div>`;
}

function viewer(model, variant) {
  const name = (mesher) => `${model.id}_${variant.id}_${mesher}`;
  const source = (mesher) => ({ name: name(mesher), source: `../meshes/${name(mesher)}.js` });
  const configuration = { meshes: { weft: source("weft"), cgal: source("cgal") }, view: variant.view ?? {} };
  const hint =
    model.dimension === 3
      ? "Drag to turn, scroll or pinch to zoom, drag with the right button or two fingers to move. Keys: arrows, + − 0."
      : "Drag to move, scroll or pinch to zoom. Keys: arrows, + − 0.";
  return `<div class="viewer" id="viewer-${variant.id}" data-title="${escape(capital(model.title))}" data-dimension="${model.dimension}">
<script type="application/json">${JSON.stringify(configuration).replaceAll("<", "\\u003c")}</script>
<div class="stage">
${poster(model, variant)}
<p class="names" aria-hidden="true"><span>weft</span><span>CGAL</span></p>
</div>
<form class="panel" aria-label="What the viewer shows" onsubmit="return false"></form>
<p class="hint">${hint}</p>
</div>`;
}

function pictures(model, variant) {
  const base = `../pictures/${model.id}_${variant.id}`;
  const picture = (file, alt, caption) =>
    `<figure><img src="${base}_${file}.webp" alt="${escape(alt)}" width="640" height="480" loading="lazy"><figcaption>${caption}</figcaption></figure>`;
  const [weft, cgal] = [row(variant, "weft"), row(variant, "CGAL")];
  const inside = (name, mesh) => `${name}: ${integer(below(mesh, 15))} of ${integer(mesh.elements)} cells below 15°`;
  return `<div class="pictures">
${picture("whole", `${model.title} by weft, whole`, "The boundary of weft's mesh")}
${picture("slivers_weft", `Cells below 15 degrees by weft`, inside("weft", weft))}
${picture("slivers_cgal", `Cells below 15 degrees by CGAL`, inside("CGAL", cgal))}
</div>`;
}

function histograms(model, variant) {
  const rows = ["weft", "CGAL"].map((mesher) => row(variant, mesher));
  const what = model.dimension === 3 ? "dihedral angles" : "angles";
  const range = (r) => `${r.mesher} from ${degrees(r.smallest_angle)} to ${degrees(r.largest_angle)}`;
  const all = histogram({
    title: `All ${what}: ${rows.map(range).join(", ")}`,
    description: `Histogram of all ${what}; ${rows.map(range).join("; ")}`,
    rows: rows.map((r) => ({ name: r.mesher, counts: r.angles, smallest: r.smallest_angle, largest: r.largest_angle })),
    upTo: 180,
    binSize: 3,
    tickEvery: 30,
  });
  if (model.dimension === 2) return all;
  const most = (r) => r.smallest_angles.findLastIndex((n) => n > 0) + 1;
  const smallest = histogram({
    title: `Smallest dihedral angle of each cell; ${degrees(70.5)} if regular`,
    description: `Histogram of the smallest dihedral angle of each cell; on average ${rows.map((r) => `${r.mesher} ${degrees(r.mean_smallest_angle)}`).join(", ")}`,
    rows: rows.map((r) => ({ name: r.mesher, counts: r.smallest_angles, smallest: r.smallest_angle, largest: most(r) })),
    upTo: 72,
    binSize: 2,
    tickEvery: 12,
  });
  return all + smallest;
}

const columnTitles = {
  weft: "weft",
  "weft, pushed": "weft, as far as it goes",
  CGAL: "CGAL",
  "CGAL, refined": "CGAL, refined only",
};

function table(model, variant) {
  const spatial = model.dimension === 3;
  const columns = Object.keys(columnTitles)
    .map((mesher) => row(variant, mesher))
    .filter(Boolean);
  const line = (title, value) =>
    `<tr><th scope="row">${title}</th>${columns.map((r) => `<td>${value(r) ?? "–"}</td>`).join("")}</tr>`;
  const times = (x) => x?.toFixed(2);
  const lines = [
    line("Vertices", (r) => integer(r.vertices)),
    line(spatial ? "Tetrahedra" : "Triangles", (r) => integer(r.elements)),
    spatial ? "" : line("Triangles over those of an ideal mesh", (r) => times(r.elements_over_ideal)),
    line(spatial ? "Smallest dihedral angle" : "Smallest angle", (r) => degrees(r.smallest_angle)),
    line(spatial ? "Largest dihedral angle" : "Largest angle", (r) => degrees(r.largest_angle)),
    line("Smallest angle, mean over elements", (r) => degrees(r.mean_smallest_angle)),
    spatial ? line("Cells below 15°", (r) => integer(below(r, 15))) : "",
    spatial ? line("Longest edge, times the size asked", (r) => times(r.longest_edge_over_size)) : "",
    columns[0].distance_over_approximation === undefined
      ? ""
      : line("Distance to the surface, times the bound asked", (r) => times(r.distance_over_approximation)),
    spatial ? line("All criteria hold", (r) => (r.mesher.startsWith("weft") ? (r.criteria_hold ? "yes" : "no") : undefined)) : "",
    line("User time, one thread", (r) => seconds(r.seconds)),
  ];
  return `<div class="scroller" tabindex="0" role="region" aria-label="Figures">
<table class="figures">
<thead><tr><td></td>${columns.map((r) => `<th scope="col">${columnTitles[r.mesher]}</th>`).join("")}</tr></thead>
<tbody>
${lines.filter(Boolean).join("\n")}
</tbody>
</table>
</div>`;
}

function asked(model, { figures }) {
  if (model.dimension === 2) {
    const size = figures.field === "uniform" ? `No edge longer than ${figures.size.toPrecision(3)}.` : "";
    const angle =
      figures.smallest_input_angle < 60
        ? `The input's own smallest angle is ${degrees(figures.smallest_input_angle)}.`
        : "";
    return `${size} CGAL refines with its angle bound of 20.7°. ${angle}`;
  }
  const lengths = [`edges up to ${figures.size}`];
  if (figures.approximation > 0) lengths.push(`boundary facets within ${figures.approximation} of the surface`);
  const sharp = figures.sharp_angle > 0 ? ` Edges are sharp from ${figures.sharp_angle}° on.` : "";
  const push =
    figures.push_seconds > 0 && row({ figures }, "weft, pushed")
      ? ` “As far as it goes” perturbs slivers for up to ${figures.push_seconds} s.`
      : "";
  return `Asked for, in parts of the longest side: ${lengths.join(", ")}, circumradius over shortest edge up to 2.${sharp} CGAL gets the same bounds in its terms.${push}`;
}

function part(model, variant) {
  const heading = variant.title ? `<h2 id="${variant.id}">${variant.title}</h2>` : "";
  return `<section class="variant"${variant.title ? ` aria-labelledby="${variant.id}"` : ""}>
${heading}
${variant.about ? `<p class="lead">${escape(variant.about)}</p>` : ""}
${viewer(model, variant)}
${model.dimension === 3 ? pictures(model, variant) : ""}
<div class="results">
${histograms(model, variant)}
${table(model, variant)}
</div>
<p class="note">${asked(model, variant)}
<a href="../meshes/${model.id}_${variant.id}_weft.mesh" download>weft's mesh</a> and
<a href="../meshes/${model.id}_${variant.id}_cgal.mesh" download>CGAL's</a> in Medit's format.</p>
</section>`;
}

export function modelPage(model, { previous, next }) {
  const link = (other, rel, arrow) =>
    other ? `<a rel="${rel}" href="${other.id}.html">${arrow(escape(capital(other.title)))}</a>` : "<span></span>";
  return page({
    title: `weft: ${model.title}`,
    root: "../",
    script: true,
    body: `<header class="top">
<nav aria-label="Gallery"><a class="home" href="../index.html"><span class="brand">weft</span> Gallery</a>
<span class="turn">${link(previous, "prev", (t) => `← ${t}`)}${link(next, "next", (t) => `${t} →`)}</span></nav>
<h1>${escape(capital(model.title))}</h1>
<p class="lead">${escape(model.about)}</p>
</header>
<main>
${model.variants.map((variant) => part(model, variant)).join("\n")}
</main>`,
  });
}
