// The page of a study is drawn while the study is calculated, even without this script. With this script, the user can
// stop the study, and open the case of a point from the figure.
"use strict";

const stop = () => document.getElementById("stop");
let loading = document.readyState === "loading";

document.addEventListener("click", (event) => {
  if (event.target.id !== "stop") return;
  window.stop();
  loading = false;
  event.target.hidden = true;
  document.querySelectorAll(".progress .left").forEach((left) => left.remove());
  document.getElementById("state").textContent = "Stopped. The points calculated so far are shown.";
});

document.addEventListener("change", (event) => choose(event.target));

// The range of another quantity is no range of the chosen quantity. Controls that `isKept` names keep their values; then
// the user presses Calculate.
function choose(control, isKept = () => false) {
  control.parentElement.querySelector(".chosen")?.remove();
  const axis = control.matches("select[name=x], select[name=y]") ? control.name : null;
  if (!axis) return;
  const range = ["from", "to", "scale"].map((part) => document.getElementById(`f.${axis}.${part}`));
  const kept = range.filter(isKept);
  range.filter((part) => !kept.includes(part)).forEach((part) => { part.value = ""; });
  const hasGoal = document.querySelector("select[name=goal]");  // a search also needs its goal
  if (!kept.length && !hasGoal && document.querySelector("select[name=x]").value) control.form.requestSubmit();
}

// Whether a user changed a control since the server sent the page.
function isChanged(control) {
  return control.value !== (control.defaultValue ?? (control.querySelector("[selected]") ?? control.options[0])?.value);
}

function watch() {
  if (!loading) return;
  if (stop()) stop().hidden = false;
  else setTimeout(watch, 30);
}

function finish() {
  loading = false;
  if (stop()) stop().hidden = true;
  prepareCopy((text) => { document.getElementById("state").textContent = text; });
  document.querySelectorAll(".plot").forEach((plot) => (plot.dataset.study ? prepareStudy(plot) : plot.dataset.content && prepareChart(plot)));
}

// The report of a single case appears only after the case is calculated, so a text says that the report is calculated.
// The report of the study needs no such text, because it shows the number of solved points.
document.addEventListener("click", (event) => {
  const link = event.target.closest("a[href*='/report?']");
  if (!link || link.pathname.startsWith(location.pathname) || event.ctrlKey || event.metaKey || event.shiftKey) return;
  document.getElementById("state").textContent = "The report is being calculated …";
  window.addEventListener("pageshow", () => { document.getElementById("state").textContent = ""; }, { once: true });
});

// Show the point at the pointer, or the point chosen with the arrow keys. A click or the key Enter opens the case of the
// point.
function prepareStudy(plot) {
  const study = JSON.parse(plot.dataset.study);
  const [xs, ys] = [study.axes[0].at, study.axes[1]?.at ?? [null]];
  const reading = plot.parentElement.querySelector(".reading");
  const ring = document.createElement("span");
  ring.className = "ring";
  ring.hidden = true;
  plot.append(ring);
  let at = [0, 0];
  const value = (i, j) => study.out[i * ys.length + j];
  const share = (number, [low, high, log]) => (log ? Math.log(number / low) / Math.log(high / low) : (number - low) / (high - low));
  const place = (i, j) => [share(xs[i], study.ranges[0]), share(study.map ? ys[j] : value(i, j), study.ranges[1])];
  const show = (i, j) => {
    at = [i, j];
    const image = plot.querySelector("img");
    const box = isNarrow() ? study.narrow : study.box;
    const [x, y] = place(i, j);
    ring.hidden = value(i, j) === null && !study.map;
    ring.style.left = `${(box[0] + x * box[2]) * image.clientWidth}px`;
    ring.style.top = `${(box[1] + (1 - y) * box[3]) * image.clientHeight}px`;
    const named = study.axes.map((axis, rank) => `${axis.name} ${rounded(axis.at[at[rank]])} ${axis.unit}`.trim());
    const found = value(i, j) === null ? "no solution" : `${rounded(value(i, j))} ${study.unit}`.trim();
    reading.textContent = `${named.join(", ")}: ${study.title} ${found}. Click to open this case.`;
  };
  const open = ([i, j]) => {
    const [path, query] = study.address.split("?");
    const fields = new URLSearchParams(query);
    fields.set(study.axes[0].path, xs[i]);
    if (study.axes[1]) fields.set(study.axes[1].path, ys[j]);
    location.href = `${path}?${fields}`;
  };
  const nearestPoint = (event) => {
    const image = plot.querySelector("img").getBoundingClientRect();
    const box = isNarrow() ? study.narrow : study.box;
    const x = ((event.clientX - image.left) / image.width - box[0]) / box[2];
    const y = 1 - ((event.clientY - image.top) / image.height - box[1]) / box[3];
    if (x < -0.03 || x > 1.03 || y < -0.05 || y > 1.05) return null;
    const i = least(xs.map((_, index) => Math.abs(share(xs[index], study.ranges[0]) - x)));
    return [i, least(ys.map((_, index) => Math.abs(place(i, index)[1] - y)))];
  };
  plot.classList.add("opens");
  plot.addEventListener("pointermove", (event) => { const found = nearestPoint(event); if (found) show(...found); });
  plot.addEventListener("click", (event) => { const found = nearestPoint(event); if (found) open(found); });
  plot.addEventListener("keydown", (event) => {
    if (event.key === "Enter") { open(at); return; }
    const step = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!step) return;
    event.preventDefault();
    show(...[xs, ys].map((values, rank) => Math.min(Math.max(at[rank] + step[rank], 0), values.length - 1)));
  });
}

function least(distances) {
  let best = 0;
  distances.forEach((distance, index) => { if (distance < distances[best]) best = index; });
  return best;
}

function rounded(value) {
  return typeof value === "number" ? Number(value.toPrecision(5)) : value;
}

watch();
if (document.readyState === "complete") finish();
else window.addEventListener("load", finish);
// Users may choose and type before this script arrives.
[...document.querySelectorAll("#study select")].filter(isChanged).forEach((select) => choose(select, isChanged));
