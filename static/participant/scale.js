// Keys on a form: 1 to 7 answer the scale in focus, Enter goes on.

import { plainDigit } from "./page.js";

export function scaleKeys(form) {
  // A key that is held led to this page; it must not send it as well.
  form.addEventListener("keydown", (event) => {
    if (event.repeat && event.key === "Enter" && !event.target.matches("textarea")) event.preventDefault();
  });
  form.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    const scale = event.target.closest("fieldset");
    const digit = plainDigit(event.key);
    const value = scale && /^[1-7]$/.test(digit) && scale.querySelector(`input[value="${digit}"]`);
    if (!value) return;
    event.preventDefault();
    value.checked = true;
    value.focus();
  });
}
