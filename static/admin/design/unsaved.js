// What differs from the saved version: a dot at each field and section, a count in the bar, one question on leaving.

const saved = JSON.parse(document.querySelector("#saved").textContent);
const NOTES = new Set(["csrf", "base", "do", "end", "shown", "emotion"]);
let changes = 0;

/** The fields of the form as the server counts them: names with all their values. */
export function fieldsOf(form) {
  const fields = new Map();
  for (const [name, value] of new FormData(form)) {
    if (NOTES.has(name) || name.endsWith(".pasted") || typeof value !== "string") continue;
    fields.set(name, [...(fields.get(name) ?? []), value.replaceAll("\r\n", "\n")]);
  }
  return fields;
}

function differs(fields, name) {
  return JSON.stringify(fields.get(name) ?? []) !== JSON.stringify(saved[name] ?? []);
}

/** Whether a field stands in a row that the saved version does not have, or in one that is gone: rows count once. */
function inOtherRow(fields, name) {
  const parts = name.split(".");
  return parts.some((part, place) => {
    if (!/^\d+$/.test(part)) return false;
    const list = parts.slice(0, place).join(".");
    return (fields.get(list) ?? []).includes(part) !== (saved[list] ?? []).includes(part);
  });
}

/** Whether a head became one of another kind, a preset a face of one's own: that is one change, not one a slider. */
function isPartOfOtherKind(fields, name) {
  const row = /^(identities\.\d+)\.(head\.|preset)/.exec(name);
  return row !== null && differs(fields, `${row[1]}.variant`);
}

function isList(form, name) {
  return form.querySelector(`.rows[data-names="${CSS.escape(name)}"], .identity[data-names="${CSS.escape(name)}"]`) !== null;
}

/** How many rows more or less there are; 1 where only their order is another. */
function rowsChanged(fields, name) {
  const [now, then] = [fields.get(name) ?? [], saved[name] ?? []];
  const moved = [...now.filter((key) => !then.includes(key)), ...then.filter((key) => !now.includes(key))];
  return moved.length || 1;
}

/** Count and mark what is not saved. */
export function countUnsaved(form) {
  const fields = fieldsOf(form);
  const changed = new Set();
  changes = 0;
  for (const name of new Set([...fields.keys(), ...Object.keys(saved)])) {
    if (name.endsWith(".document") || !differs(fields, name)) continue;
    if (isPartOfOtherKind(fields, name)) continue;
    changed.add(name);
    if (inOtherRow(fields, name)) continue;
    changes += isList(form, name) ? rowsChanged(fields, name) : 1;
  }
  mark(form, changed);
  document.querySelector("#unsaved").hidden = changes === 0;
  document.querySelector("#count").textContent = `${changes} unsaved ${changes === 1 ? "change" : "changes"}`;
}

function mark(form, changed) {
  for (const field of form.querySelectorAll("[data-names]")) {
    const own = field.dataset.names.split(" ").some((name) => changed.has(name));
    const dot = field.querySelector(":scope > :is(label, legend, .check) .dot, :scope > legend + * .dot");
    if (dot) dot.hidden = !own;
  }
  for (const control of form.querySelectorAll(".control")) markControl(control, changed);
  for (const tab of form.querySelectorAll(".tabs-of-heads label")) {
    const head = tab.querySelector("input").value;
    tab.querySelector(".dot").hidden = ![...changed].some((name) => name.startsWith(`${head}.`));
  }
  for (const link of form.querySelectorAll(".sections li a")) markSection(form, link, changed);
}

function markControl(control, changed) {
  const label = control.querySelector("label");
  let dot = label.querySelector(".dot");
  if (!dot) {
    dot = document.createElement("span");
    dot.className = "dot";
    label.append(dot);
  }
  dot.hidden = !changed.has(control.querySelector("[name]").name);
}

function markSection(form, link, changed) {
  const card = document.querySelector(link.getAttribute("href"));
  const bad = link.querySelector(".bad") !== null;
  const names = [...card.querySelectorAll("[data-names]")].flatMap((field) => field.dataset.names.split(" "));
  const inputs = [...card.querySelectorAll("[name]")].map((input) => input.name);
  const any = [...names, ...inputs].some((name) => changed.has(name));
  link.querySelector(".dot").hidden = bad || !any;
  const fine = link.querySelector(".fine");
  if (fine) fine.hidden = any;
}

/** Ask once before somebody leaves with something unsaved. */
export function guardLeaving(form) {
  let sending = false;
  form.addEventListener("submit", () => {
    sending = true;
  });
  window.addEventListener("pageshow", () => {
    sending = false;
  });
  window.addEventListener("beforeunload", (event) => {
    if (changes > 0 && !sending) event.preventDefault();
  });
  document.querySelector(".discard").addEventListener("click", () => {
    sending = true;
  });
}
