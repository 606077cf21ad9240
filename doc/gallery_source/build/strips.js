// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pictures of the README: several meshes of a finished gallery in a row, as PNG files with clear backgrounds.
//
//   node build/strips.js GALLERY_FOLDER OUTPUT_FOLDER

import { writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { launch } from "./browser.js";

const glass = (mesher) => ({ mesher, cut: 0, below: 15, glass: true });

const strips = {
  gallery_cut: {
    width: 380,
    height: 340,
    pictures: [
      { model: "gear", state: { mesher: "weft" } },
      { model: "elephant", state: { mesher: "weft" } },
      { model: "dino", state: { mesher: "weft" } },
      { model: "three_materials", state: { mesher: "weft" } },
    ],
  },
  gallery_slivers: {
    width: 380,
    height: 380,
    pictures: [
      { model: "elephant", state: glass("weft"), counted: true },
      { model: "elephant", state: glass("cgal"), counted: true },
      { model: "dino", state: glass("weft"), counted: true },
      { model: "dino", state: glass("cgal"), counted: true },
    ],
  },
  gallery_plane: {
    width: 640,
    height: 400,
    pictures: [
      { model: "gulf", viewer: "viewer-graded", state: { mesher: "weft" }, counted: true },
      { model: "gulf", viewer: "viewer-graded", state: { mesher: "cgal" }, counted: true },
    ],
  },
};

const captionHeight = 34;

/** Runs in the page of a model. @returns a data URL */
async function takeInPage([viewer, state, width, height, counted, captionRoom]) {
  const section = document.getElementById(viewer);
  await gallery.open(section);
  section.viewer.set(state);
  const picture = section.viewer.picture(width, height, { lineWidth: 0.9 });
  const canvas = Object.assign(document.createElement("canvas"), { width, height: height + (counted ? captionRoom : 0) });
  const context = canvas.getContext("2d");
  context.drawImage(picture, 0, 0);
  if (counted) {
    const pane = section.viewer.shownPanes()[0];
    const { mesh } = pane;
    const integer = (n) => n.toLocaleString("en");
    const smallest = mesh.qualities.reduce((least, q) => Math.min(least, q), 180);
    const what =
      mesh.dimension === 3
        ? `${integer(mesh.cellsBelow(state.below))} cells below ${state.below}°`
        : `${integer(mesh.count)} triangles, angles from ${smallest.toFixed(1)}°`;
    context.fillStyle = "#7b8490"; // can be read on light and on dark
    context.font = "600 18px system-ui, sans-serif";
    context.textAlign = "center";
    context.fillText(`${pane.name === "cgal" ? "CGAL" : "weft"}: ${what}`, width / 2, height + 22);
  }
  return canvas.toDataURL("image/png");
}

/** Runs in an empty page. */
async function joinInPage([urls, width, height]) {
  const canvas = Object.assign(document.createElement("canvas"), { width: width * urls.length, height });
  const context = canvas.getContext("2d");
  for (const [i, url] of urls.entries()) {
    const image = new Image();
    image.src = url;
    await image.decode();
    context.drawImage(image, i * width, 0);
  }
  return canvas.toDataURL("image/png");
}

async function main([galleryFolder, outputFolder]) {
  if (!outputFolder) throw new Error("usage: node build/strips.js GALLERY_FOLDER OUTPUT_FOLDER");
  const browser = await launch();
  try {
    for (const [name, { width, height, pictures }] of Object.entries(strips)) {
      const urls = [];
      for (const { model, viewer = "viewer-mesh", state, counted = false } of pictures) {
        const page = await browser.newPage();
        await page.goto(pathToFileURL(join(resolve(galleryFolder), "models", `${model}.html`)).href);
        urls.push(await page.evaluate(takeInPage, [viewer, state, width, height, counted, captionHeight]));
        await page.close();
      }
      const page = await browser.newPage();
      const whole = height + (pictures.some(({ counted }) => counted) ? captionHeight : 0);
      const url = await page.evaluate(joinInPage, [urls, width, whole]);
      writeFileSync(join(outputFolder, `${name}.png`), Buffer.from(url.slice(url.indexOf(",") + 1), "base64"));
      await page.close();
      console.log(`${name}.png`);
    }
  } finally {
    await browser.close();
  }
}

main(process.argv.slice(2)).catch((error) => {
  console.error(`strips: ${error.message}`);
  process.exitCode = 1;
});
