// One item: when the face was to be seen, and the answers to its questions.

import { byId, painted } from "./page.js";
import { answerForm } from "./answerform.js";

const seen = { onset_ms: null, hidden_ms: 0 };
let shown = Promise.resolve();

/** Start the page of an item. */
export function start() {
  answerForm({ response });
  watchHidden();
  shown = onset();
}

async function response(data, form) {
  const chosen = Math.round(performance.now());
  // Whoever answers within the first frames has an onset as well.
  await shown;
  const fields = [...form.querySelectorAll("fieldset")];
  const values = Object.fromEntries(fields.map((field) => [plain(nameOf(field)), valueOf(field, data)]));
  return {
    trial: data.get("trial"),
    item: Number(data.get("item")),
    values,
    timing: { ...seen, chosen_ms: chosen },
  };
}

const nameOf = (field) => field.querySelector("input, textarea").name;
const plain = (name) => name.replace(/^q-/, "");

function valueOf(field, data) {
  const name = nameOf(field);
  return field.querySelector("input[type=checkbox]") ? data.getAll(name) : data.get(name) || null;
}

async function onset() {
  await byId("portrait")?.decode().catch(() => null);
  seen.onset_ms = Math.round(await painted(() => {}));
}

function watchHidden() {
  let since = document.hidden ? performance.now() : null;
  addEventListener("visibilitychange", () => {
    if (document.hidden) since = performance.now();
    else if (since !== null) {
      seen.hidden_ms = Math.round(seen.hidden_ms + performance.now() - since);
      since = null;
    }
  });
}
