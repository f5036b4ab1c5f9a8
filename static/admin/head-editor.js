// What every editor of heads does: the portrait follows the sliders, and a line beside it says what happens. Without
// script the forms work by their buttons.

import { send, show } from "./drawing.js";
import { begin, check, follow, reset } from "./sliders.js";

const PAUSE = 250;
const form = document.querySelector("#editor");
const portrait = document.querySelector("#portrait");
const status = document.querySelector("#status");

export function say(words, wrong = false) {
  status.textContent = words;
  status.classList.toggle("wrong", wrong);
}

/** Send the form to an address under its own. */
export function ask(address, signal) {
  return send(`${form.getAttribute("action")}/${address}`, new URLSearchParams(new FormData(form)), signal);
}

/**
 * Begin to edit; returns what draws the head at once.
 * @param {object} how
 * @param {string[]} how.unseen names of fields that are in no picture
 * @param {(input?: HTMLInputElement) => void} how.altered is called on a change of a field, without one where several went back
 * @param {(headers: Headers) => void} how.drawn is called with what the server tells beside a portrait
 */
export function edit({ unseen = ["name"], altered = () => {}, drawn = () => {} } = {}) {
  let timer = 0;
  let asking = null;

  /** Draw once the sliders have rested; a change while drawing starts anew. */
  function changed() {
    clearTimeout(timer);
    asking?.abort();
    timer = setTimeout(draw, PAUSE);
  }

  async function draw() {
    clearTimeout(timer);
    asking?.abort();
    const mine = new AbortController();
    asking = mine;
    const begun = performance.now();
    form.classList.add("busy");
    say("Drawing");
    try {
      const reply = await ask("preview", mine.signal);
      await show(portrait, await reply.blob());
      name(reply.headers.get("X-Head-Hash").slice(0, 12));
      drawn(reply.headers);
      say(`Drawn in ${((performance.now() - begun) / 1000).toFixed(1)} s`);
    } catch (error) {
      if (mine.signal.aborted || error.newer) return;
      say(error.message, true);
    } finally {
      if (asking === mine) form.classList.remove("busy");
    }
  }

  form.addEventListener("input", (event) => {
    if (!follow(event.target)) return;
    altered(event.target);
    if (!unseen.includes(event.target.name)) changed();
  });

  form.addEventListener("change", (event) => {
    const wrong = check(event.target);
    if (wrong) say(wrong, true);
    // The name is not in the picture, but it is in the hash; nobody waits for that at every letter.
    if (event.target.name === "name") changed();
  });

  form.addEventListener("click", (event) => {
    if (!reset(event)) return;
    altered();
    changed();
  });

  form.addEventListener("submit", (event) => {
    // Enter in any field asks for the first button, which previews.
    if (event.submitter?.hasAttribute("formaction")) return;
    event.preventDefault();
    draw();
  });

  begin(form);
  return draw;
}

function name(digest) {
  document.querySelector("#digest").textContent = digest;
  document.querySelector("#short").textContent = digest;
}
