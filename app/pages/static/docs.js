// The OpenAPI document, shown by Swagger below our own heading. The page is dark if the system is dark. Links to single
// operations are left out, because Swagger puts these links inside buttons.
"use strict";

const LABELS = { ".examples-select-element": "Example", ".body-param__text": "Request body", ".highlight-code pre": "Code" };
const operations = document.getElementById("swagger-ui");
const dark = matchMedia("(prefers-color-scheme: dark)");
const follow = () => document.documentElement.classList.toggle("dark-mode", dark.matches);

// Name the parts that Swagger leaves without a name, and make them accessible with the keyboard.
function name() {
  for (const [selector, label] of Object.entries(LABELS)) {
    for (const part of operations.querySelectorAll(`${selector}:not([aria-label])`)) {
      part.setAttribute("aria-label", label);
      part.tabIndex = 0;
    }
  }
}

// As on every page, a source that we know only at second hand is called "secondary source".
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
