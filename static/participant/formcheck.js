// What is missing in a form, said as the server would say it: a summary that takes focus, and the same words at the field.

import { byId } from "./page.js";

/** Mark every field that is missing; true when there is one. */
export function wrongFields(form) {
  const fields = [...form.querySelectorAll("[data-required], [data-optional]")];
  const missing = fields.filter((field) => !answered(field));
  for (const field of fields) mark(field, missing.includes(field));
  const summary = byId("summary");
  if (!summary) return missing.length > 0;
  summary.hidden = missing.length === 0;
  summary.querySelector("ul").replaceChildren(...missing.map(link));
  title(missing.length > 0);
  if (missing.length) summary.focus();
  return missing.length > 0;
}

function answered(field) {
  const entry = field.querySelector(".entry");
  // A number field holds no value when what was typed is no number.
  if (entry) return entry.validity.valid && (entry.value.trim() !== "" || "optional" in field.dataset);
  return "optional" in field.dataset || field.querySelector("input:checked") !== null;
}

const sentence = (field) => field.dataset.required ?? field.dataset.optional;

function mark(field, wrong) {
  const input = field.querySelector("input, textarea");
  const message = field.querySelector(".missing");
  field.classList.toggle("wrong", wrong);
  message.querySelector("span").textContent = wrong ? sentence(field) : "";
  if (wrong) input.setAttribute("aria-describedby", message.id);
  else input.removeAttribute("aria-describedby");
  if (input.type === "checkbox" || input.matches(".entry")) input.toggleAttribute("aria-invalid", wrong);
}

function link(field) {
  const item = document.createElement("li");
  const input = field.querySelector("input, textarea");
  const anchor = Object.assign(document.createElement("a"), { href: `#${input.id}`, textContent: sentence(field) });
  anchor.addEventListener("click", (event) => {
    event.preventDefault();
    input.focus();
  });
  item.append(anchor);
  return item;
}

let plain = null;

function title(wrong) {
  plain ??= document.title;
  document.title = wrong ? document.body.dataset.errorTitle.replace("{title}", plain) : plain;
}
