// The editor of heads of the bundled face model: beside the sliders, shares of ancestry, and a look that follows the head
// until it has one of its own.

import { ask, edit, say } from "./head-editor.js";
import { tell } from "./sliders.js";

const form = document.querySelector("#editor");
const own = document.querySelector("#own_look");
const copying = document.querySelector("#copy");

let painted = null;

function tellShares() {
  const amounts = ["african", "asian", "caucasian"].map((name) => [name, Number(form.elements[name].value)]);
  const total = amounts.reduce((sum, [, amount]) => sum + amount, 0);
  const words = amounts.map(([name, amount]) => `${name} ${Math.round((100 * amount) / total)} %`);
  document.querySelector("#shares").textContent = total > 0 ? words.join(", ") : "Set at least one above 0.";
}

function look() {
  return [...form.querySelectorAll(".control > [name^='look.']")];
}

/** Set the fields of the look: to what the head wears, or back to what was painted. */
function wear(values, anew = false) {
  for (const input of look()) {
    input.value = values[input.name];
    if (anew) input.dataset.start = input.value;
    tell(input);
  }
}

/** A look of one's own is put away and taken out again; the head's own way shows in between. */
function dress() {
  if (!own.checked) painted = Object.fromEntries(look().map((input) => [input.name, input.value]));
  else if (painted) wear(painted);
}

function altered(input) {
  // Whoever paints wants to see it, with the slider or by the number beside it.
  if (look().includes(input?.closest(".control")?.querySelector("[name]"))) own.checked = true;
  if (input === own) dress();
  tellShares();
}

function drawn(headers) {
  if (!own.checked) wear(JSON.parse(headers.get("X-Head-Look")), true);
}

async function copy() {
  try {
    const reply = await ask("document");
    await navigator.clipboard.writeText(await reply.text());
    say("Document copied");
  } catch (error) {
    say(error.message, true);
  }
}

copying.addEventListener("click", copy);
copying.hidden = !navigator.clipboard;
edit({ unseen: ["name", "children"], altered, drawn });
tellShares();
