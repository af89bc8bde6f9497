// Functions that all pages with figures share: they copy the link and the code, and show the values of a figure at the
// pointer or at a place chosen with the arrow keys.
"use strict";

function prepareCopy(say) {
  const copy = document.getElementById("copy");
  copy?.addEventListener("click", async (event) => {
    event.preventDefault();
    try {
      await navigator.clipboard.writeText(copy.href);
      say("Link copied.");
    } catch {
      history.replaceState(null, "", copy.href);
      say("The link is in the address bar.");
    }
  });
}

// Put the address at which the reader sees this service into the code, and add a button that copies the code.
function prepareCode(say) {
  for (const code of document.querySelectorAll("pre.code")) {
    code.textContent = code.textContent.replace("http://localhost:8000", location.origin);
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: "Copy" });
    button.addEventListener("click", async () => {
      await navigator.clipboard.writeText(code.textContent);
      say("Code copied.");
    });
    code.before(button);
  }
}

// Show the values of a figure at the pointer, at a place chosen with the arrow keys, and in a table. The values are part
// of the page, or are requested when they are needed.
function prepareChart(plot) {
  let asked = null;
  const values = () => { asked ??= valuesOf(plot); return asked; };
  const details = plot.parentElement.querySelector(".values");
  if (plot.dataset.values) details?.addEventListener("toggle", async () => { if (details.open) fillTable(details, await values()); });
  const wake = async (event) => {
    plot.removeEventListener("pointerenter", wake);
    plot.removeEventListener("focus", wake);
    const found = await values();
    if (found.panels.length) follow(plot, found);
    plot.dispatchEvent(new PointerEvent("pointermove", event));
  };
  plot.addEventListener("pointerenter", wake);
  plot.addEventListener("focus", wake);
}

// Whether the page shows the images for phones; the width is that of the images' sources.
function isNarrow() {
  return matchMedia("(max-width: 40rem)").matches;
}

async function valuesOf(plot) {
  if (!plot.dataset.values) return JSON.parse(plot.dataset.content);
  const answer = await fetch(plot.dataset.values);
  return answer.ok ? answer.json() : { panels: [], narrow: [], header: [], lines: [], more: 0 };
}

function fillTable(details, { header, lines, more }) {
  const table = document.createElement("table");
  const row = (kind, cells) => {
    const line = document.createElement("tr");
    line.append(...cells.map((text) => { const cell = document.createElement(kind); cell.textContent = text; return cell; }));
    return line;
  };
  table.createTHead().append(row("th", header));
  table.createTBody().append(...lines.map((line) => row("td", line)));
  const note = document.createElement("p");
  note.textContent = more ? `and ${more} more lines in the CSV file` : "";
  details.querySelector(".scroll").replaceChildren(table, note);
}

function follow(plot, found) {
  const shown = () => (isNarrow() ? found.narrow : found.panels);  // asked anew each time, for a phone is turned
  const reading = plot.parentElement.querySelector(".reading");
  const cursor = document.createElement("span");
  cursor.className = "cursor";
  cursor.hidden = true;
  plot.append(cursor);
  let place = { panel: 0, index: -1 };
  const show = (panel, index) => {
    place = { panel, index };
    const { box, range, name, unit, curves } = shown()[panel];
    const at = curves[0].x[index];
    const image = plot.querySelector("img");
    const share = range[2] ? Math.log(at / range[0]) / Math.log(range[1] / range[0]) : (at - range[0]) / (range[1] - range[0]);
    cursor.style.left = `${(box[0] + share * box[2]) * image.clientWidth}px`;
    cursor.style.top = `${box[1] * image.clientHeight}px`;
    cursor.style.height = `${box[3] * image.clientHeight}px`;
    cursor.hidden = false;
    const values = curves.map((curve) => [curve, curve.y[nearest(curve.x, at)]]).filter(([, value]) => value !== null);
    reading.textContent = `${name} ${at} ${unit}: ` + values.map(([curve, value]) => `${curve.name} ${value} ${curve.unit}`.trim()).join(" · ");
  };
  plot.addEventListener("pointermove", (event) => {
    const image = plot.querySelector("img").getBoundingClientRect();
    const x = (event.clientX - image.left) / image.width;
    const y = (event.clientY - image.top) / image.height;
    const panels = shown();
    const panel = panels.findIndex(({ box }) => x >= box[0] && x <= box[0] + box[2] && y >= box[1] - 0.05 && y <= box[1] + box[3] + 0.05);
    if (panel < 0) return;
    const { box, range, curves } = panels[panel];
    const share = (x - box[0]) / box[2];
    const at = range[2] ? range[0] * (range[1] / range[0]) ** share : range[0] + share * (range[1] - range[0]);
    show(panel, nearest(curves[0].x, at));
  });
  plot.addEventListener("keydown", (event) => {
    const step = { ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowDown: [1, 0], ArrowUp: [-1, 0] }[event.key];
    if (!step) return;
    event.preventDefault();
    const panels = shown();
    const panel = Math.min(Math.max(place.panel + step[0], 0), panels.length - 1);
    const last = panels[panel].curves[0].x.length - 1;
    show(panel, Math.min(Math.max(place.index + step[1], 0), last));
  });
}

function nearest(values, wanted) {
  let best = 0;
  values.forEach((value, index) => { if (value !== null && Math.abs(value - wanted) < Math.abs(values[best] - wanted)) best = index; });
  return best;
}
