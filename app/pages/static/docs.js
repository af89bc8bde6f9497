// The OpenAPI document as Swagger shows it, below our own heading, dark where the system is. Links to single operations
// are left out: Swagger puts them inside buttons.
"use strict";

const LABELS = { ".examples-select-element": "Example", ".body-param__text": "Request body", ".highlight-code pre": "Code" };
const operations = document.getElementById("swagger-ui");
const dark = matchMedia("(prefers-color-scheme: dark)");
const follow = () => document.documentElement.classList.toggle("dark-mode", dark.matches);

// What Swagger leaves without a name or out of reach of the keyboard.
function name() {
  for (const [selector, label] of Object.entries(LABELS)) {
    for (const part of operations.querySelectorAll(`${selector}:not([aria-label])`)) {
      part.setAttribute("aria-label", label);
      part.tabIndex = 0;
    }
  }
}

// Sources that were not read are secondary sources here, as on every page.
function cited(answer) {
  if (answer.url.endsWith(operations.dataset.document)) {
    answer.text = answer.text.replace(/as read in a public implementation/g, "secondary source");
  }
  return answer;
}

dark.addEventListener("change", follow);
follow();
new MutationObserver(name).observe(operations, { childList: true, subtree: true });
SwaggerUIBundle({
  url: operations.dataset.document,
  domNode: operations,
  deepLinking: false,
  showExtensions: true,
  showCommonExtensions: true,
  responseInterceptor: cited,
  plugins: [() => ({ components: { InfoContainer: () => null } })],
});
