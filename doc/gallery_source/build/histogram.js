// SPDX-License-Identifier: GPL-3.0-or-later
//
// Histograms of angles as SVG inside a page: CGAL's as an area behind weft's. Colours come from the style sheet.

const width = 560;
const height = 230;
const axes = { left: 18, right: 18, top: 26, bottom: 40 };

function binned(counts, size, upTo) {
  const bins = new Array(upTo / size).fill(0);
  counts.slice(0, upTo).forEach((n, i) => (bins[Math.floor(i / size)] += n));
  const sum = counts.reduce((a, b) => a + b, 0);
  return bins.map((n) => n / sum);
}

/**
 * @param rows [weft's, CGAL's], each {name, counts by whole degrees, smallest, largest}
 * @param upTo end of the axis, in degrees
 */
export function histogram({ title, description, rows, upTo, binSize, tickEvery }) {
  const shares = rows.map(({ counts }) => binned(counts, binSize, upTo));
  const most = Math.max(...shares.flat());
  const x = (degrees) => axes.left + (degrees / upTo) * (width - axes.left - axes.right);
  const y = (share) => height - axes.bottom - (share / most) * (height - axes.top - axes.bottom);
  const outline = (bins) =>
    bins
      .map((share, i) => `L${x(i * binSize).toFixed(1)} ${y(share).toFixed(1)}H${x((i + 1) * binSize).toFixed(1)}`)
      .join("");
  const classes = ["weft", "cgal"];
  const areas = shares
    .map((bins, i) => `<path class="area ${classes[i]}" d="M${x(0)} ${y(0)}${outline(bins)}V${y(0)}Z"/>`)
    .reverse();
  const ticks = [];
  for (let degrees = 0; degrees <= upTo; degrees += tickEvery)
    ticks.push(
      `<line class="tick" x1="${x(degrees)}" x2="${x(degrees)}" y1="${y(0)}" y2="${y(0) + 5}"/>` +
        `<text x="${x(degrees)}" y="${y(0) + 18}">${degrees}°</text>`,
    );
  // The extremes, which are too few to be seen as bars.
  const extremes = rows.map(({ smallest, largest }, i) => {
    const at = y(0) + 26 + 8 * i;
    const [from, to] = [x(smallest), x(Math.min(largest ?? upTo, upTo))];
    return `<path class="range ${classes[i]}" d="M${from.toFixed(1)} ${at - 3}v6m0-3H${to.toFixed(1)}m0-3v6"/>`;
  });
  const legend = rows.map(
    ({ name }, i) =>
      `<rect class="area ${classes[i]}" x="${axes.left + 2 + 80 * i}" y="6" width="12" height="12" rx="2"/>` +
      `<text class="name" x="${axes.left + 20 + 80 * i}" y="16">${name}</text>`,
  );
  return `<figure class="histogram">
<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${description}">
${areas.join("\n")}
<line class="axis" x1="${axes.left}" x2="${width - axes.right}" y1="${y(0)}" y2="${y(0)}"/>
${ticks.join("")}
${extremes.join("")}
${legend.join("")}
</svg>
<figcaption>${title}</figcaption>
</figure>`;
}
