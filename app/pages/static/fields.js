// The search in the table of all fields. Only the rows that contain every word of the search are shown.
"use strict";

const search = document.getElementById("search");
const count = document.getElementById("count");
const rows = [...document.querySelectorAll("tr[id]")].map((row) => ({ row, text: row.textContent.toLowerCase() }));

function find() {
  const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
  let shown = 0;
  for (const { row, text } of rows) {
    row.hidden = !words.every((word) => text.includes(word));
    shown += row.hidden ? 0 : 1;
  }
  count.textContent = words.length ? `${shown} of ${rows.length} fields` : "";
}

search.closest("p").hidden = false;
search.addEventListener("input", find);
find();
