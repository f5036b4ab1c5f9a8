// The editor of heads: fields beside the sliders, and a portrait that follows them. Without this script the form works
// by its buttons.

import { send as post, show } from "./drawing.js";
import { begin, check, follow, reset, tell } from "./sliders.js";

const PAUSE = 250;
const form = document.querySelector("#editor");
const portrait = document.querySelector("#portrait");
const status = document.querySelector("#status");
const own = document.querySelector("#own_look");

let timer = 0;
let asking = null;
let painted = null;

function ranges() {
  return form.querySelectorAll(".control > [name]");
}

function tellShares() {
  const amounts = ["african", "asian", "caucasian"].map((name) => [name, Number(form.elements[name].value)]);
  const total = amounts.reduce((sum, [, amount]) => sum + amount, 0);
  const words = amounts.map(([name, amount]) => `${name} ${Math.round((100 * amount) / total)} %`);
  document.querySelector("#shares").textContent = total > 0 ? words.join(", ") : "Set at least one above 0.";
}

function say(words, wrong = false) {
  status.textContent = words;
  status.classList.toggle("wrong", wrong);
}

/** Draw once the sliders have rested; a change while drawing starts anew. */
function changed() {
  clearTimeout(timer);
  asking?.abort();
  timer = setTimeout(draw, PAUSE);
}

async function draw() {
  const mine = new AbortController();
  asking = mine;
  const begun = performance.now();
  form.classList.add("busy");
  say("Drawing");
  try {
    const reply = await send("/admin/heads/preview", mine.signal);
    await show(portrait, await reply.blob());
    name(reply.headers.get("X-Head-Hash"));
    if (!own.checked) wear(JSON.parse(reply.headers.get("X-Head-Look")), true);
    say(`Drawn in ${((performance.now() - begun) / 1000).toFixed(1)} s`);
  } catch (error) {
    if (mine.signal.aborted || error.newer) return;
    say(error.message, true);
  } finally {
    if (asking === mine) form.classList.remove("busy");
  }
}

function send(address, signal) {
  return post(address, new URLSearchParams(new FormData(form)), signal);
}

function name(digest) {
  document.querySelector("#digest").textContent = digest.slice(0, 12);
  document.querySelector("#short").textContent = digest.slice(0, 12);
}

function look() {
  return [...ranges()].filter((input) => input.name.startsWith("look."));
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

async function copy() {
  try {
    const reply = await send("/admin/heads/document");
    await navigator.clipboard.writeText(await reply.text());
    say("Document copied");
  } catch (error) {
    say(error.message, true);
  }
}

form.addEventListener("input", (event) => {
  const input = event.target;
  if (!follow(input)) return;
  // Whoever paints wants to see it.
  if (input.name?.startsWith("look.")) own.checked = true;
  if (input === own) dress();
  tellShares();
  if (!["name", "children"].includes(input.name)) changed();
});

form.addEventListener("change", (event) => {
  const input = event.target;
  const wrong = check(input);
  if (wrong) say(wrong, true);
  // The name is not in the picture, but it is in the hash; nobody waits for that at every letter.
  if (input.name === "name") changed();
});

form.addEventListener("click", (event) => {
  if (!reset(event)) return;
  tellShares();
  changed();
});

form.addEventListener("submit", (event) => {
  // Enter in any field asks for the first button, which previews.
  if (event.submitter?.hasAttribute("formaction")) return;
  event.preventDefault();
  clearTimeout(timer);
  asking?.abort();
  draw();
});
document.querySelector("#copy").addEventListener("click", copy);

begin(form);
document.querySelector("#copy").hidden = !navigator.clipboard;
tellShares();
