// The portrait of the open identity: it follows the sliders, at most every 120 ms, and the old one stays until the new
// one is ready. A preset has pictures of its own; a face in the making is drawn from its sliders.

import { send, show } from "../drawing.js";
import { begin, check, follow, reset } from "../sliders.js";

const PAUSE = 120;
const REST = 700;
const LATER = 2000;
let timer = 0;
let resting = 0;
let busy = false;
let again = false;
let round = 0;

const portrait = document.querySelector("#portrait");
const status = document.querySelector("#status");

function panelOf(form) {
  const chosen = form.querySelector('.tabs-of-heads input:checked') ?? form.querySelector(".tabs-of-heads input");
  return chosen && form.querySelector(`.panel[data-head="${CSS.escape(chosen.value)}"]`);
}

function emotionOf(form) {
  return form.querySelector('.thumbs input:checked')?.value ?? "neutral";
}

function say(words, wrong = false) {
  status.textContent = words;
  status.classList.toggle("wrong", wrong);
}

/** What the server needs to draw a face: the sliders of a panel under their own names. */
function body(form, panel, emotion) {
  const prefix = `${panel.dataset.head}.head.`;
  const fields = new URLSearchParams([["csrf", form.elements.csrf.value], ["emotion", emotion]]);
  for (const [name, value] of new FormData(form)) {
    if (name.startsWith(prefix)) fields.append(name.slice(prefix.length), value);
  }
  return fields;
}

/** A picture of the open identity. */
async function picture(form, panel, emotion, large) {
  if (panel.dataset.variant === "document") {
    const reply = await send(panel.dataset.preview, body(form, panel, emotion));
    return reply.blob();
  }
  const name = panel.querySelector('[name$=".preset"]:checked')?.value;
  if (!/^[a-z0-9-]{1,40}(:[A-Za-z0-9_.-]{1,80})?$/.test(name ?? "")) throw new Error("The face model has no such head.");
  const reply = await fetch(`/admin/heads/portraits/${name}.png?emotion=${emotion}${large ? "&large=1" : ""}`);
  if (!reply.ok) throw new Error("The portrait could not be drawn. Try again.");
  return reply.blob();
}

async function draw(form) {
  if (busy) {
    again = true;
    return;
  }
  const panel = panelOf(form);
  if (!panel) return;
  busy = true;
  const begun = performance.now();
  try {
    await show(portrait, await picture(form, panel, emotionOf(form), true));
    say(`drawn in ${Math.round(performance.now() - begun)} ms`);
  } catch (error) {
    if (!error.newer) say(error.message, true);
    if (error.later) setTimeout(() => changed(form), LATER);
  } finally {
    busy = false;
  }
  if (!again) {
    rested(form);
    return;
  }
  again = false;
  await draw(form);
}

/** The small pictures come when the sliders rest and the large one is there; a change meanwhile stops them. */
async function drawThumbs(form, mine) {
  for (const image of form.querySelectorAll(".thumbs img")) {
    const panel = panelOf(form);
    if (mine !== round || busy || !panel) return;
    try {
      await show(image, await picture(form, panel, image.dataset.emotion, false));
    } catch {
      return;
    }
  }
}

function rested(form) {
  const mine = round;
  clearTimeout(resting);
  resting = setTimeout(() => drawThumbs(form, mine), REST);
}

function changed(form) {
  round += 1;
  clearTimeout(resting);
  if (timer) return;
  timer = setTimeout(() => {
    timer = 0;
    draw(form);
  }, PAUSE);
}

function name(form) {
  const chosen = form.querySelector('.tabs-of-heads input:checked');
  const tabs = [...form.querySelectorAll('.tabs-of-heads input')];
  document.querySelector("#letter").textContent = chosen ? String.fromCharCode(65 + tabs.indexOf(chosen)) : "";
  document.querySelector("#emotion-name").textContent = emotionOf(form);
}

/** After rows have come or gone: numbers beside sliders, and the portrait of what is open now. */
export function beginPortrait(form) {
  begin(form);
  const again = form.querySelector(".again");
  if (again) again.hidden = true;
  if (!form.querySelector(".tabs-of-heads input:checked")) {
    const first = form.querySelector(".tabs-of-heads input");
    if (first) first.checked = true;
  }
  name(form);
  changed(form);
}

export function letPortraitFollow(form) {
  form.addEventListener("input", (event) => {
    const input = event.target;
    if (!input.closest(".identity, .thumbs") || !follow(input)) return;
    if (input.name?.includes(".head.look.")) input.closest(".panel").querySelector(".own").checked = true;
    if (input.matches('textarea, [type="file"], [name$=".head.name"]')) return;
    name(form);
    changed(form);
  });
  form.addEventListener("change", (event) => {
    const wrong = check(event.target);
    if (wrong) say(wrong, true);
  });
  form.addEventListener("click", (event) => {
    if (!reset(event)) return;
    form.dispatchEvent(new Event("editor:changed"));
    changed(form);
  });
}
