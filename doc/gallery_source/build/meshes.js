// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs the programs that mesh the models. What is newer than its program isn't made again.

import { spawn } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gunzipSync } from "node:zlib";
import { readMedit } from "./medit.js";

function run(command, args) {
  return new Promise((resolve, reject) => {
    const child = spawn(command, args, { stdio: ["ignore", "inherit", "pipe"] });
    let complaints = "";
    child.stderr.on("data", (text) => (complaints += text));
    child.on("error", reject);
    child.on("close", (status) =>
      status === 0 ? resolve() : reject(new Error(complaints.trim() || `${command} ended with status ${status}`)),
    );
  });
}

/** The input's name or file; undefined if it is missing. */
function inputOf(model, { root, modelsFolder, meshFolder }) {
  if (model.input && !/\.(poly|off)$/.test(model.input)) return model.input;
  if (model.input) return join(root, "data", model.input);
  const file = modelsFolder && join(modelsFolder, model.file);
  if (!file || !existsSync(file)) return undefined;
  if (!file.endsWith(".gz")) return file;
  const unpacked = join(meshFolder, model.file.replace(/^.*\/|\.gz$/g, "")); // the programs do without zlib
  writeFileSync(unpacked, gunzipSync(readFileSync(file)));
  return unpacked;
}

async function meshVariant(model, variant, input, options) {
  const { programs, meshFolder, pushSeconds } = options;
  const program = join(programs, model.dimension === 2 ? "gallery_planar" : "gallery_spatial");
  const prefix = join(meshFolder, `${model.id}_${variant.id}`);
  const bounds = [...variant.arguments];
  if (model.dimension === 3 && pushSeconds > 0) bounds.push("--push", String(pushSeconds));
  const [done, asked] = [`${prefix}.json`, `${prefix}.args`];
  const isFresh =
    existsSync(done) &&
    existsSync(asked) &&
    readFileSync(asked, "utf8") === JSON.stringify(bounds) &&
    statSync(done).mtimeMs > statSync(program).mtimeMs;
  if (!isFresh) {
    rmSync(done, { force: true });
    await run(program, [input, "--output", prefix, ...bounds]);
    writeFileSync(asked, JSON.stringify(bounds));
  }
  return {
    ...variant,
    figures: JSON.parse(readFileSync(done, "utf8")),
    meshes: { weft: readMedit(`${prefix}_weft.mesh`), cgal: readMedit(`${prefix}_cgal.mesh`) },
  };
}

/**
 * Meshes all models, one after the other, so that times can be compared.
 * @returns the models with figures and meshes, and those that are missing
 */
export async function meshModels(models, options) {
  mkdirSync(options.meshFolder, { recursive: true });
  const meshed = [];
  const missing = [];
  for (const model of models) {
    const input = inputOf(model, options);
    if (!input) {
      missing.push(model);
      continue;
    }
    const start = Date.now();
    const variants = [];
    for (const variant of model.variants) variants.push(await meshVariant(model, variant, input, options));
    console.log(`${model.title}: meshed (${((Date.now() - start) / 1000).toFixed(1)} s)`);
    meshed.push({ ...model, variants });
  }
  return { meshed, missing };
}
