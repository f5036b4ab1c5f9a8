// What was filled in and not sent yet, so that a reload loses nothing. It stays in this tab, until the server has the
// answer or the participation is over.

import { address } from "./page.js";
import { forget, recall, remember } from "./tab.js";

const NAME = `draft ${address}`;

/** Forget what was filled in. */
export const forgetDraft = () => forget(NAME);

/** Fill a form in as it was left, and keep up with it. */
export function drafted(form) {
  const of = ["kind", "trial", "item"].map((name) => form.elements[name]?.value ?? "").join(" ");
  const kept = recall(NAME);
  if (kept?.of === of) restore(form, kept.values);
  const keep = () => remember(NAME, { of, values: Object.fromEntries(fieldsOf(form).map((field) => [field.id, said(field)])) });
  for (const type of ["input", "change"]) form.addEventListener(type, keep);
}

const fieldsOf = (form) => [...form.querySelectorAll("input:not([type=hidden]), textarea")].filter(({ id }) => id);
const ticked = ({ type }) => type === "checkbox" || type === "radio";
const said = (field) => (ticked(field) ? field.checked : field.value);

function restore(form, values) {
  for (const field of fieldsOf(form)) {
    if (!(field.id in values) || said(field) === values[field.id]) continue;
    if (ticked(field)) field.checked = values[field.id];
    else field.value = values[field.id];
    // The outline of a card follows its slider.
    field.dispatchEvent(new Event("input"));
  }
}
