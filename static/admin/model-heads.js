// The editor of heads of identity modes: a portrait that follows the sliders. Without this script the form works by its
// buttons.

import { send, show } from "./drawing.js";
import { begin, check, follow, reset } from "./sliders.js";

const PAUSE = 250;
const form = document.querySelector("#editor");
const portrait = document.querySelector("#portrait");
const status = document.querySelector("#status");

let timer = 0;
let asking = null;

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
    const body = new URLSearchParams(new FormData(form));
    const reply = await send(`${form.getAttribute("action")}/preview`, body, mine.signal);
    await show(portrait, await reply.blob());
    const digest = reply.headers.get("X-Head-Hash").slice(0, 12);
    document.querySelector("#digest").textContent = digest;
    document.querySelector("#short").textContent = digest;
    say(`Drawn in ${((performance.now() - begun) / 1000).toFixed(1)} s`);
  } catch (error) {
    if (mine.signal.aborted || error.newer) return;
    say(error.message, true);
  } finally {
    if (asking === mine) form.classList.remove("busy");
  }
}

form.addEventListener("input", (event) => {
  if (follow(event.target) && event.target.name !== "name") changed();
});

form.addEventListener("change", (event) => {
  const wrong = check(event.target);
  if (wrong) say(wrong, true);
  // The name is not in the picture, but it is in the hash.
  if (event.target.name === "name") changed();
});

form.addEventListener("click", (event) => {
  if (reset(event)) changed();
});

form.addEventListener("submit", (event) => {
  // Enter in any field asks for the first button, which previews.
  if (event.submitter?.hasAttribute("formaction")) return;
  event.preventDefault();
  changed();
});

begin(form);
draw();
