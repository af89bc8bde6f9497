// Results that follow the form while a user types. The page also works without this script. After each change, the script
// requests the page again, and copies the result and the states of the fields from the new page.
"use strict";

const WAIT_MS = 350;
const form = document.getElementById("form");
const written = form.elements.written; // lists texts that the server wrote into the form, so that the server can tell them from typed texts
const long = Number(document.querySelector(".work").dataset.long);
let timer = 0;
let running = null;
let pressed = false; // whether the button Calculate was pressed while a request was running
let shown = caseOf(new DOMParser().parseFromString(form.outerHTML, "text/html").forms[0]); // without what was typed before this script arrived

function pairsOf(element) {
  const picked = new Map([...element.querySelectorAll("input[type=radio]:checked")].map((radio) => [radio.name, radio.value]));
  const left = new Set([...element.querySelectorAll("input[type=radio]")].map((radio) => radio.value));
  for (const name of picked.values()) {
    left.delete(name);
    const excluded = element.querySelector(`[data-field="${CSS.escape(name)}"]`)?.dataset.excludes ?? "";
    if (element.querySelector(`[name="${CSS.escape(name)}"]`)?.value.trim()) excluded.split(" ").forEach((other) => left.add(other));
  }
  return [...new FormData(element)].filter(([name, text]) => !name.startsWith("pick:") && name !== written.name && text.trim() && !left.has(name));
}

function caseOf(element) {
  return new URLSearchParams(pairsOf(element)).toString().replaceAll("%2C", ",").replaceAll("%3A", ":");
}

function schedule() {
  clearTimeout(timer);
  timer = setTimeout(update, WAIT_MS);
}

async function update(force = false) {
  const wanted = caseOf(form);
  if (wanted === shown && !force) return;
  if (running !== null) { pressed ||= force; return; }
  running = wanted;
  const result = document.getElementById("result");
  result.classList.add("old");
  result.setAttribute("aria-busy", "true");
  say("calculating …");
  try {
    const page = await ask(wanted, force);
    // Before the first result, faults are shown only after Calculate was pressed, because a user may not have reached all
    // fields yet.
    if (!page.ok && !force && result.querySelector(":scope > .empty")) leave(result);
    else if (caseOf(form) === wanted || page.ok) take(page.document, page.ok);
    if (force && !page.ok) form.querySelector(".wrong :is(input:not([type=radio]), select, textarea)")?.focus();
    shown = wanted;
    history.replaceState(null, "", page.address);
  } catch {
    say("The service does not answer. The result below belongs to the earlier inputs.");
  }
  running = null;
  const again = pressed;
  pressed = false;
  if (again) update(true);
  else if (caseOf(form) !== wanted) schedule();
}

// The server reads the typed texts and redirects to the link of the case. The form is posted if the case is too long for
// a link, or if the form is empty and its faults are to be shown.
async function ask(wanted, force) {
  const sent = `${wanted}&${new URLSearchParams({ written: written.value })}`;
  const post = sent.length > long || (!wanted && force);
  const options = post ? { method: "POST", body: new URLSearchParams(sent) } : {};
  const answer = await fetch(post || !wanted ? form.action : `${form.action}?${sent}`, options);
  const page = new DOMParser().parseFromString(await answer.text(), "text/html");
  const linked = post && wanted ? page.getElementById("copy")?.href : answer.url.replace(/[?&]written=[^&]*/, "");
  return { ok: answer.ok, address: linked ?? `${form.action}?unlinked=on`, document: page };
}

function say(text) {
  document.getElementById("state").textContent = text;
}

function leave(result) {
  result.classList.remove("old");
  result.removeAttribute("aria-busy");
  say("");
}

function take(page, ok) {
  const fresh = page.getElementById("result");
  const here = document.getElementById("result");
  if (!fresh) { say(page.querySelector(".problem")?.textContent.trim() ?? "The service sent no result."); return; }
  document.querySelector(".jump").replaceWith(document.adoptNode(page.querySelector(".jump")));
  if (!ok && here.querySelector(".cards")) { keepResult(here, fresh, page); return; }
  const open = new Map([...here.querySelectorAll("details")].map((part, index) => [index, part.open]));
  here.replaceWith(document.adoptNode(fresh));
  if (open.size === fresh.querySelectorAll("details").length) {
    fresh.querySelectorAll("details").forEach((part, index) => { part.open = open.get(index); });
  }
  takeFields(page);
  prepareResult();
}

// After an error, the last good result stays below the error messages, and is dimmed.
function keepResult(here, fresh, page) {
  here.querySelector(":scope > .problem")?.remove();
  document.getElementById("state").after(document.adoptNode(fresh.querySelector(".problem")));
  here.removeAttribute("aria-busy");
  say("The result below belongs to the earlier inputs.");
  takeFields(page);
}

function takeFields(page) {
  for (const rows of document.querySelectorAll("[data-rows]")) {
    const fresh = page.getElementById(rows.id);
    const more = fresh ? [...fresh.children].slice(rows.children.length) : [];
    rows.append(...more.map((row) => document.adoptNode(row)));
  }
  for (const fresh of page.querySelectorAll("[data-field]")) {
    const here = document.querySelector(`[data-field="${CSS.escape(fresh.dataset.field)}"]`);
    if (here) takeField(here, fresh);
  }
  for (const fresh of page.querySelectorAll("[data-section]")) {
    const here = document.querySelector(`[data-section="${CSS.escape(fresh.dataset.section)}"]`);
    const note = here?.querySelector(":scope > summary .note");
    if (note) note.textContent = fresh.querySelector(":scope > summary .note").textContent;
    if (here && fresh.querySelector(".wrong")) here.open = true;
  }
}

function takeField(here, fresh) {
  const [control, source] = [here, fresh].map((field) => field.querySelector("input:not([type=radio]), select, textarea"));
  here.className = fresh.className;
  for (const name of ["placeholder", "aria-invalid", "aria-describedby"]) {
    if (source.hasAttribute(name)) control.setAttribute(name, source.getAttribute(name));
    else control.removeAttribute(name);
  }
  const fault = here.querySelector(".fault");
  fault.textContent = fresh.querySelector(".fault").textContent;
  fault.hidden = !fault.textContent;
  const empty = here.querySelector(".blank");
  empty.textContent = fresh.querySelector(".blank").textContent;
  empty.hidden = !empty.textContent;
  here.querySelector(".help")?.replaceChildren(...fresh.querySelector(".help").cloneNode(true).childNodes);
  here.querySelector(".assumed")?.remove();
  const mark = fresh.querySelector(".assumed");
  if (mark) (here.querySelector(":scope > label") ?? here).append(" ", document.adoptNode(mark));
}

// If the user types into a field, clear the fields that this field excludes.
function clearFellows(control) {
  const names = control.closest("[data-excludes]")?.dataset.excludes.split(" ") ?? [];
  if (!control.value.trim()) return;
  for (const other of form.querySelectorAll("input:not([type=radio]), select, textarea")) {
    if (names.some((name) => other.name === name || other.name.startsWith(`${name}.`))) other.value = "";
  }
}

// The switch of an optional section says yes once a field of the section is filled in. To say no empties the section.
function followSwitch(control) {
  for (let part = control.closest("[data-section]"); part; part = part.parentElement.closest("[data-section]")) {
    const own = [...part.querySelectorAll("select")].find((each) => each.name === part.dataset.section);
    if (own && own !== control && control.value.trim()) own.value = own.options[1].value;
    if (own === control && !own.value) {
      part.querySelectorAll("input:not([type=radio]), select, textarea").forEach((each) => { each.value = ""; });
    }
  }
}

function count(area) {
  const items = area.value.trim().split(/[\s;]/.test(area.value.trim()) ? /[\s;]+/ : /,/).filter(Boolean).length;
  document.getElementById(area.dataset.count).textContent = items ? `${items} values` : "";
}

// Scroll a field to the middle of the window, or the beginning of any other part of the page to the top of the window.
function goTo(address) {
  const target = document.getElementById(decodeURIComponent(address.slice(1)));
  if (!target) return;
  for (let part = target.parentElement; part; part = part.parentElement) if (part.tagName === "DETAILS") part.open = true;
  target.focus();
  target.scrollIntoView({ block: target.closest(".fields") ? "center" : "start" });
}

// The cards that stay at the top of the window must not hide anything. If the page scrolls to a part, this part
// therefore begins below the cards. Tall cards do not stay at the top.
function keepClear() {
  const cards = document.querySelector(".result > .cards");
  cards?.classList.toggle("tall", cards.offsetHeight > 0.35 * window.innerHeight);
  const stays = cards && getComputedStyle(cards).position === "sticky";
  document.documentElement.style.scrollPaddingTop = stays ? `${cards.offsetHeight + 8}px` : "";
}

function prepareResult() {
  keepClear();
  prepareCopy(say);
  prepareCode(say);
  document.querySelectorAll(".plot").forEach(prepareChart);
}

form.addEventListener("input", (event) => { clearFellows(event.target); followSwitch(event.target); schedule(); });
form.addEventListener("change", schedule);
form.addEventListener("input", (event) => { if (event.target.dataset.count) count(event.target); });
form.addEventListener("submit", (event) => {
  if (event.submitter?.hasAttribute("formaction")) return;
  event.preventDefault();
  clearTimeout(timer);
  update(true);
});
// The key Escape hides the help of a field until the field gets the focus again.
form.addEventListener("keydown", (event) => { if (event.key === "Escape") event.target.closest(".field")?.classList.add("quiet"); });
form.addEventListener("focusin", () => form.querySelectorAll(".quiet").forEach((field) => field.classList.remove("quiet")));
// The help between the fields stays until the mouse button is released, so that a control below the help does not move
// away from the pointer during a click.
document.addEventListener("mousedown", () => {
  const field = document.activeElement?.closest("#form .field");
  field?.classList.add("held");
  window.addEventListener("mouseup", () => setTimeout(() => field?.classList.remove("held")), { once: true });
});
document.addEventListener("click", (event) => {
  const link = event.target.closest("a[href^='#']");
  if (link) { event.preventDefault(); goTo(link.getAttribute("href")); }
});
const example = document.getElementById("example");
const openExample = () => { if (example.value) example.form.submit(); };
example.addEventListener("change", openExample);
window.addEventListener("resize", keepClear);
form.querySelectorAll("textarea[data-count]").forEach(count);
prepareResult();
// Users may type or choose before this script arrives.
schedule();
openExample();
