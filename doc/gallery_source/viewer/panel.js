// SPDX-License-Identifier: GPL-3.0-or-later
//
// The controls beside a viewer: ordinary form elements with labels, which set the viewer's state.

import { bestAngle, SCALE_TOP, scaleGradient } from "./colours.js";

let numberOfPanels = 0;

function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (value !== false) node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children);
  return node;
}

export class Panel {
  constructor(viewer, parent) {
    this.viewer = viewer;
    this.parent = parent;
    this.id = `panel-${++numberOfPanels}`;
    const spatial = viewer.mesh.dimension === 3;
    parent.replaceChildren(
      ...[
        viewer.panes.length > 1 && this.choice("Mesh", "mesher", { weft: "weft", cgal: "CGAL", both: "Side by side" }),
        spatial && this.cutControls(),
        this.choice("Colour", "colour", this.colourings()),
        this.legend(),
        this.highlightControls(spatial),
        element("div", { class: "row" }, this.tick("Edges", "edges"), this.resetButton(), this.pictureButton()),
      ].filter(Boolean),
    );
    this.refresh();
  }

  colourings() {
    const { dimension, numberOfSubdomains } = this.viewer.mesh;
    const result = { quality: "Quality" };
    if (numberOfSubdomains > 1) result.subdomain = "Subdomain";
    if (dimension === 3) result.patch = "Patch";
    result.plain = "Plain";
    return result;
  }

  set(changes) {
    this.viewer.set(changes);
    this.refresh();
  }

  // ---- Kinds of controls

  choice(title, key, labels) {
    const options = Object.entries(labels).map(([value, label]) => {
      const id = `${this.id}-${key}-${value}`;
      const input = element("input", {
        type: "radio",
        name: `${this.id}-${key}`,
        id,
        value,
        checked: this.viewer.state[key] === value,
        onchange: () => this.set({ [key]: value }),
      });
      return element("span", {}, input, element("label", { for: id }, label));
    });
    return element(
      "fieldset",
      { "data-key": key },
      element("legend", {}, title),
      element("div", { class: "segments" }, ...options),
    );
  }

  slider(title, key, { max, step, describe }) {
    const id = `${this.id}-${key}`;
    const output = element("output", { for: id });
    const input = element("input", { type: "range", id, min: 0, max, step, value: this.viewer.state[key] });
    const show = () => (output.textContent = describe(this.viewer.state[key]));
    input.addEventListener("input", () => {
      this.set({ [key]: Number(input.value) });
      show();
    });
    show();
    return element("div", { class: "slider" }, element("label", { for: id }, title), output, input);
  }

  tick(title, key) {
    const id = `${this.id}-${key}`;
    const input = element("input", {
      type: "checkbox",
      id,
      checked: this.viewer.state[key],
      onchange: () => this.set({ [key]: input.checked }),
    });
    return element("span", { class: "tick" }, input, element("label", { for: id }, title));
  }

  // ---- The controls

  cutControls() {
    return element(
      "div",
      { class: "group" },
      this.slider("Cut away", "cut", { max: 1, step: 0.005, describe: (x) => `${Math.round(100 * x)} %` }),
      this.choice("Across", "direction", { x: "x", y: "y", z: "z", view: "The view" }),
      this.tick("From the other side", "flipped"),
    );
  }

  highlightControls(spatial) {
    this.counts = element("p", { class: "counts", "aria-live": "polite" });
    const what = spatial ? "Cells with a dihedral angle below" : "Triangles with an angle below";
    const slider = this.slider(what, "below", { max: 40, step: 0.5, describe: (x) => (x > 0 ? `${x}°` : "off") });
    if (!spatial) return element("div", { class: "group" }, slider, this.counts);
    const glass = this.tick("Show them inside glass", "glass");
    glass.querySelector("input").addEventListener("change", (event) => {
      if (!event.target.checked || this.viewer.state.below > 0) return;
      const input = slider.querySelector("input"); // else there would be nothing to see
      input.value = 15;
      input.dispatchEvent(new Event("input"));
    });
    return element("div", { class: "group" }, slider, this.counts, glass);
  }

  legend() {
    const ticks = [0, 20, 40, SCALE_TOP].map((x) => element("span", {}, `${x}°`));
    const what = this.viewer.mesh.dimension === 3 ? "smallest dihedral angle" : "smallest angle";
    const note = `${what} of each ${this.viewer.mesh.dimension === 3 ? "cell" : "triangle"}; ${bestAngle(this.viewer.mesh.dimension).toFixed(1)}° if regular`;
    this.scale = element(
      "div",
      { class: "scale" },
      element("div", { class: "gradient", style: `background: ${scaleGradient}`, "aria-hidden": "true" }),
      element("div", { class: "ticks" }, ...ticks),
      element("p", {}, note),
    );
    return this.scale;
  }

  resetButton() {
    return element("button", { type: "button", onclick: () => this.viewer.resetCamera() }, "Reset the view");
  }

  pictureButton() {
    const save = () => {
      const { canvas } = this.viewer;
      const picture = this.viewer.picture(2 * canvas.clientWidth, 2 * canvas.clientHeight, { lineWidth: 1.5 });
      const link = element("a", { href: picture.toDataURL("image/png"), download: "weft.png" });
      link.click();
    };
    return element("button", { type: "button", onclick: save }, "Save a picture");
  }

  /** Shows what follows from the state. */
  refresh() {
    const { state, panes } = this.viewer;
    // Hidden, but with its room kept: the canvas shouldn't change its size.
    this.scale.style.visibility = state.colour !== "quality" || state.glass ? "hidden" : "visible";
    const integer = (n) => n.toLocaleString("en");
    const counts = panes
      .map(({ name, mesh }) => {
        const all = integer(mesh.count);
        return `${{ weft: "weft", cgal: "CGAL" }[name]}: ${state.below > 0 ? `${integer(mesh.cellsBelow(state.below))} of ${all}` : all}`;
      })
      .join(" · ");
    this.counts.textContent = `${counts} ${this.viewer.mesh.dimension === 3 ? "cells" : "triangles"}`;
    this.parent.closest(".viewer")?.setAttribute("data-mesher", state.mesher);
  }
}
