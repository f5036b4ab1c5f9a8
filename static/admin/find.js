// The slash key goes to the search field, from wherever nothing is being typed.

const field = document.querySelector("#find");
const typing = "input, textarea, select, [contenteditable]";

if (field) {
  field.parentElement.querySelector("kbd").hidden = false;
  addEventListener("keydown", (event) => {
    if (event.key !== "/" || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target instanceof Element && event.target.matches(typing)) return;
    event.preventDefault();
    field.focus();
    field.select();
  });
}
