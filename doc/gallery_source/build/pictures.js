// SPDX-License-Identifier: GPL-3.0-or-later
//
// Takes the pictures of the pages with the pages' own viewers, in a headless Chromium.

import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { launch } from "./browser.js";

const size = { width: 960, height: 720 };
const wideSize = { width: 1440, height: 720 };

/** What the pictures of a mesh show, by file name. */
function scenes(model, variant) {
  if (model.dimension === 2) return { weft: { mesher: "weft" }, both: { mesher: "both" } };
  const cut = variant.view?.state ?? {};
  const glass = { cut: 0, below: 15, glass: true };
  const plain = { cut: 0, glass: false, below: 0, colour: "quality" };
  return {
    whole: { ...plain, colour: cut.colour === "subdomain" ? "subdomain" : "plain", mesher: "weft" },
    cut_weft: { ...plain, ...cut, mesher: "weft" },
    both: { ...plain, ...cut, mesher: "both" },
    slivers_weft: { ...glass, mesher: "weft" },
    slivers_cgal: { ...glass, mesher: "cgal" },
  };
}

/** A picture of a viewer in some state, as the bytes of a WebP file. */
export async function takePicture(page, viewerId, state, { width, height, lineWidth }) {
  const url = await page.evaluate(
    ([id, changes, w, h, line]) => {
      const { viewer } = document.getElementById(id);
      viewer.set(changes);
      return viewer.picture(w, h, { lineWidth: line }).toDataURL("image/webp", 0.9);
    },
    [viewerId, state, width, height, lineWidth],
  );
  return Buffer.from(url.slice(url.indexOf(",") + 1), "base64");
}

export async function takePictures(models, folder) {
  mkdirSync(join(folder, "pictures"), { recursive: true });
  const browser = await launch();
  try {
    const page = await browser.newPage({ viewport: { width: 1000, height: 800 } });
    for (const model of models) {
      const start = Date.now();
      await page.goto(pathToFileURL(join(folder, "models", `${model.id}.html`)).href);
      for (const variant of model.variants) {
        const id = `viewer-${variant.id}`;
        await page.evaluate((viewer) => gallery.open(document.getElementById(viewer)).then(() => undefined), id);
        for (const [name, state] of Object.entries(scenes(model, variant))) {
          const shape = state.mesher === "both" ? wideSize : size;
          const bytes = await takePicture(page, id, state, { ...shape, lineWidth: model.dimension === 3 ? 1.2 : 1 });
          writeFileSync(join(folder, "pictures", `${model.id}_${variant.id}_${name}.webp`), bytes);
        }
        await page.evaluate((viewer) => document.getElementById(viewer).viewer.dispose(), id);
      }
      console.log(`${model.title}: pictures (${((Date.now() - start) / 1000).toFixed(1)} s)`);
    }
  } finally {
    await browser.close();
  }
}
