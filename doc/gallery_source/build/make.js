// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes the gallery; doc/make_gallery calls it.

import { build } from "esbuild";
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import os from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { meshModels } from "./meshes.js";
import { models, quick } from "./models.js";
import { packMesh } from "./pack.js";
import { landingPage, modelPage } from "./pages.js";
import { takePictures } from "./pictures.js";

const source = resolve(dirname(fileURLToPath(import.meta.url)), "..");
const root = resolve(source, "../..");

/** One classic script: browsers don't load modules from file://. */
async function bundleViewer(folder) {
  await build({
    entryPoints: [join(source, "viewer/main.js")],
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2020",
    legalComments: "inline", // the licence of three.js
    outfile: join(folder, "viewer.js"),
    logLevel: "warning",
  });
}

function writeMeshes(meshed, folder) {
  for (const model of meshed)
    for (const variant of model.variants) {
      variant.bytes = {};
      for (const [mesher, mesh] of Object.entries(variant.meshes)) {
        const name = `${model.id}_${variant.id}_${mesher}`;
        const script = packMesh(name, mesh);
        variant.bytes[mesher] = script.length;
        writeFileSync(join(folder, "meshes", `${name}.js`), script);
      }
    }
}

function writePages(meshed, missing, folder) {
  mkdirSync(join(folder, "models"), { recursive: true });
  const version = readFileSync(join(root, "include/weft/version.h"), "utf8")
    .match(/^#define WEFT_VERSION_(MAJOR|MINOR|PATCH) [0-9]+$/gm)
    .map((line) => line.split(" ")[2])
    .join(".");
  const cgal = meshed[0].variants[0].figures.cgal_version;
  const date = new Date().toISOString().slice(0, 10);
  const about = `weft ${version} against CGAL ${cgal}, ${date}, ${os.cpus()[0].model.trim()}.`;
  writeFileSync(join(folder, "index.html"), landingPage({ models: meshed, missing, about }));
  meshed.forEach((model, i) => {
    const around = { previous: meshed[i - 1], next: meshed[i + 1] };
    writeFileSync(join(folder, "models", `${model.id}.html`), modelPage(model, around));
  });
  copyFileSync(join(source, "style.css"), join(folder, "gallery.css"));
}

async function main() {
  const { values } = parseArgs({
    options: {
      programs: { type: "string" },
      output: { type: "string" },
      models: { type: "string" },
      quick: { type: "boolean", default: false },
      push: { type: "string", default: "0" },
      only: { type: "string" }, // ids, separated by commas
    },
  });
  const folder = resolve(values.output);
  for (const part of ["models", "pictures"]) rmSync(join(folder, part), { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const ids = values.only?.split(",") ?? (values.quick ? quick : models.map(({ id }) => id));
  const unknown = ids.filter((id) => !models.some((model) => model.id === id));
  if (unknown.length > 0) throw new Error(`there is no model ${unknown.join(", ")}`);
  const wanted = models.filter(({ id }) => ids.includes(id));
  const { meshed, missing } = await meshModels(wanted, {
    root,
    programs: values.programs,
    modelsFolder: values.models,
    meshFolder: join(folder, "meshes"),
    pushSeconds: Number(values.push),
  });
  if (missing.length > 0)
    console.log(`left out, since their files weren't found: ${missing.map(({ title }) => title).join(", ")}`);
  await bundleViewer(folder);
  writeMeshes(meshed, folder);
  writePages(meshed, missing, folder);
  await takePictures(meshed, folder);
  console.log(`the gallery is ${join(folder, "index.html")}`);
}

main().catch((error) => {
  console.error(`make_gallery: ${error.message}`);
  process.exitCode = 1;
});
