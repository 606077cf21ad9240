// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brings the viewers of a page to life. A viewer's meshes are fetched by script elements when it is opened, since pages
// from file:// may load scripts, but nothing else.

import { decode } from "./mesh.js";
import { Panel } from "./panel.js";
import { Viewer } from "./viewer.js";

const waiting = new Map(); // by mesh name

/** Scripts of meshes call this. */
function receive(name, packed) {
  waiting.get(name)?.(packed);
}

function load(name, source) {
  return new Promise((resolve, reject) => {
    waiting.set(name, resolve);
    const script = document.createElement("script");
    script.src = source;
    script.onload = () => script.remove(); // its text isn't needed any more
    script.onerror = () => reject(new Error(`${source} can't be loaded`));
    document.head.append(script);
  });
}

async function open(section) {
  const stage = section.querySelector(".stage");
  stage.setAttribute("aria-busy", "true");
  try {
    const { meshes, view } = JSON.parse(section.querySelector("script[type='application/json']").textContent);
    const names = Object.keys(meshes);
    const packed = await Promise.all(names.map((name) => load(meshes[name].name, meshes[name].source)));
    const canvas = document.createElement("canvas");
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute(
      "aria-label",
      `${section.dataset.title}: arrow keys turn the mesh, plus and minus zoom, 0 resets the view`,
    );
    const decoded = Object.fromEntries(names.map((name, i) => [name, decode(packed[i])]));
    section.classList.add("open");
    stage.querySelector(".poster").remove();
    stage.prepend(canvas);
    const viewer = new Viewer(canvas, decoded, view);
    section.viewer = viewer;
    section.panel = new Panel(viewer, section.querySelector(".panel"));
    return viewer;
  } catch (error) {
    section.classList.add("failed");
    const message = document.createElement("p");
    message.className = "failure";
    message.textContent = `The viewer can't be shown: ${error.message}`;
    stage.append(message);
    throw error;
  } finally {
    stage.removeAttribute("aria-busy");
  }
}

for (const section of document.querySelectorAll(".viewer"))
  section.querySelector(".poster button").addEventListener("click", async () => {
    await open(section);
    section.querySelector("canvas").focus({ preventScroll: true });
  });

window.gallery = { receive, open };
