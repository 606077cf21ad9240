// SPDX-License-Identifier: GPL-3.0-or-later
//
// Opens every page of a gallery from file:// in a headless Chromium and uses it as a visitor would; doc/test_gallery
// calls it. What is checked is what is on the screen.

import assert from "node:assert/strict";
import { existsSync, readdirSync } from "node:fs";
import { join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { launch } from "../build/browser.js";

const folder = resolve(process.argv[2]);
const address = (name) => pathToFileURL(join(folder, name)).href;

/** A page that keeps what goes wrong in it. */
async function newPage(browser, options) {
  const page = await browser.newPage({ viewport: { width: 1100, height: 900 }, ...options });
  page.complaints = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !/GPU stall|swiftshader/i.test(message.text()))
      page.complaints.push(message.text());
  });
  page.on("pageerror", (error) => page.complaints.push(error.message));
  page.on("requestfailed", (request) => page.complaints.push(`${request.url()} failed`));
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) page.complaints.push(`${request.url()} isn't a local file`);
  });
  return page;
}

// ---- Pixels

/** Screenshots of an element, decoded in a page of its own. */
class Camera {
  constructor(page) {
    this.page = page;
  }

  async decode(picture) {
    return this.page.evaluate(async (data) => {
      const image = new Image();
      image.src = `data:image/png;base64,${data}`;
      await image.decode();
      const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
      const context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      window.before = window.now;
      window.now = context.getImageData(0, 0, image.width, image.height).data;
      const colours = new Set();
      let changed = 0;
      if (window.before && before.length !== now.length) return { colours: 0, changed: NaN }; // another size
      for (let i = 0; i < now.length; i += 4) {
        colours.add((now[i] << 16) | (now[i + 1] << 8) | now[i + 2]);
        if (!window.before) continue;
        const difference = [0, 1, 2].reduce((sum, k) => sum + Math.abs(now[i + k] - before[i + k]), 0);
        if (difference > 24) ++changed;
      }
      return { colours: colours.size, changed: changed / (now.length / 4) };
    }, picture.toString("base64"));
  }

  /** Forgets the shot before. */
  async start(locator) {
    await this.page.evaluate(() => delete window.now);
    return this.shoot(locator);
  }

  /** @returns the number of colours, and the share of pixels that differ from the shot before */
  async shoot(locator) {
    return this.decode(await locator.screenshot({ animations: "disabled" }));
  }
}

// ---- Pages

async function checkImages(page) {
  const broken = await page.evaluate(async () => {
    const bad = [];
    for (const image of document.images) {
      image.loading = "eager";
      await image.decode().catch(() => bad.push(image.src));
      if (image.naturalWidth === 0) bad.push(image.src);
    }
    return bad;
  });
  assert.deepEqual(broken, [], "pictures that don't load");
}

async function checkWidth(page) {
  const overflow = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  assert.ok(overflow <= 0, `wider than the window by ${overflow} pixels`);
}

async function checkLinks(page) {
  const links = await page.evaluate(() => Array.from(document.links, (link) => link.href));
  assert.ok(links.length > 0);
  const missing = await page.evaluate(() =>
    Array.from(document.querySelectorAll("input, canvas, button, a"))
      .filter((e) => !(e.labels?.length || e.ariaLabel || e.textContent.trim()))
      .map((e) => e.outerHTML),
  );
  assert.deepEqual(missing, [], "controls without a name");
  return links;
}

/** Waits until what was asked for is on the screen. */
const settled = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => setTimeout(() => requestAnimationFrame(done), 60))));

const trianglesOf = (section) => section.evaluate((element) => element.viewer.triangles);

async function useViewer(page, section, camera, dimension) {
  const canvas = section.locator("canvas");
  const check = async (what, act, least = 0.002) => {
    await act();
    await settled(page);
    const { changed } = await camera.shoot(canvas);
    assert.ok(changed >= least, `${what}: only ${(100 * changed).toFixed(2)} % of the pixels change`);
  };
  const pick = (key, value) => section.locator(`fieldset[data-key=${key}] input[value=${value}] + label`).click();
  const slide = (label, value) => section.getByLabel(label).fill(String(value));

  await section.getByRole("button", { name: "Open the viewer" }).click();
  await canvas.waitFor();
  await page.waitForFunction((element) => element.viewer !== undefined, await section.elementHandle());
  await settled(page);
  const first = await camera.start(canvas);
  assert.ok(first.colours > 100, `the mesh isn't seen: ${first.colours} colours`);

  await check("dragging", async () => {
    const box = await canvas.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 70, box.y + box.height / 2 + 30, { steps: 5 });
    await page.mouse.up();
    await page.waitForTimeout(300); // until the mesh has come to rest
  });
  await check("a key", async () => {
    await canvas.focus();
    await page.keyboard.press("ArrowLeft");
    await page.waitForTimeout(300);
  });
  await check("zooming", async () => page.keyboard.press("+"));
  await check("weft's mesh alone", () => pick("mesher", "weft"));
  await check("CGAL's mesh", () => pick("mesher", "cgal"));
  await check("edges", () => section.getByLabel("Edges").uncheck());
  if (dimension === 3) {
    await slide("Cut away", 0);
    await settled(page);
    await camera.shoot(canvas);
    const whole = await trianglesOf(section);
    await check("cutting", () => slide("Cut away", 0.5), 0.01);
    const cut = await trianglesOf(section);
    assert.notEqual(cut, whole, "cutting leaves the number of triangles as it was");
    await check("turning the plane", () => pick("direction", "view"), 0.01);
    assert.notEqual(await trianglesOf(section), cut);
    await check("cutting from the other side", () => section.getByLabel("From the other side").click(), 0.01);
    await section.getByLabel("From the other side").uncheck(); // so that the cut is seen
    await pick("colour", "plain");
    await settled(page);
    await camera.shoot(canvas);
  }
  const inputs = await section.locator("fieldset[data-key=colour] input").all();
  const colours = await Promise.all(inputs.map((input) => input.getAttribute("value")));
  for (const colour of colours) {
    // Against the first: two of the others may look alike, as a single patch and none do.
    await pick("colour", colour === colours[0] ? colours[1] : colours[0]);
    await settled(page);
    await camera.shoot(canvas);
    await check(`colouring by ${colour}`, () => pick("colour", colour));
  }
  await check("highlighting", () => slide(/angle below/, 40));
  assert.match(await section.locator(".counts").textContent(), /^weft: [0-9,]+ of [0-9,]+ · CGAL: [0-9,]+ of [0-9,]+ (cells|triangles)$/);
  if (dimension === 3) await check("glass", () => section.getByLabel("Show them inside glass").check(), 0.01);
  await section.evaluate((element) => element.viewer.dispose());
}

async function checkModel(browser, camera, name) {
  const page = await newPage(browser);
  await page.goto(address(`models/${name}`));
  await checkImages(page);
  await checkWidth(page);
  for (const section of await page.locator(".viewer").all())
    await useViewer(page, section, camera, Number(await section.getAttribute("data-dimension")));
  await checkLinks(page);
  await page.setViewportSize({ width: 360, height: 740 });
  await settled(page);
  await checkWidth(page);
  assert.deepEqual(page.complaints, []);
  await page.close();
}

async function checkLanding(browser, models) {
  const backgrounds = [];
  for (const colorScheme of ["light", "dark"]) {
    const page = await newPage(browser, { colorScheme });
    await page.goto(address("index.html"));
    await checkImages(page);
    const links = await checkLinks(page);
    for (const name of models) assert.ok(links.includes(address(`models/${name}`)), `no link to ${name}`);
    for (const link of links) assert.ok(existsSync(fileURLToPath(link)), `${link} is missing`);
    await page.setViewportSize({ width: 360, height: 740 });
    await checkWidth(page);
    backgrounds.push(await page.evaluate(() => getComputedStyle(document.body).backgroundColor));
    assert.deepEqual(page.complaints, []);
    await page.close();
  }
  assert.notEqual(backgrounds[0], backgrounds[1], "light and dark look the same");
}

async function main() {
  const models = readdirSync(join(folder, "models")).filter((name) => name.endsWith(".html"));
  assert.ok(models.length > 0, "there are no pages");
  const wanted = process.argv.slice(3);
  const tested = models.filter((name) => wanted.length === 0 || wanted.includes(name.replace(".html", "")));
  const browser = await launch();
  let failed = 0;
  const run = async (name, check) => {
    const start = Date.now();
    try {
      await check();
      console.log(`ok ${name} (${((Date.now() - start) / 1000).toFixed(1)} s)`);
    } catch (error) {
      ++failed;
      console.error(`failed ${name}: ${error.message}`);
    }
  };
  try {
    const camera = new Camera(await browser.newPage());
    await run("index.html", () => checkLanding(browser, models));
    for (const name of tested) await run(name, () => checkModel(browser, camera, name));
  } finally {
    await browser.close();
  }
  console.log(`${tested.length + 1 - failed} pages passed, ${failed} failed`);
  process.exitCode = failed > 0 ? 1 : 0;
}

main().catch((error) => {
  console.error(`test_gallery: ${error.message}`);
  process.exitCode = 1;
});
