// The entry page: measures window and screen, so that nobody takes a place on a device that the study does not admit.

import { byId, say } from "./page.js";

const NARROW = 640;
const note = byId("too-little");
const { width = 0, height = 0, noPhones } = note.dataset;
const needs = { least_width: Number(width), least_height: Number(height), phones: noPhones === undefined };
const coarse = matchMedia("(pointer: coarse)").matches;

function look() {
  const text = problem();
  if (note.textContent !== text) note.textContent = text;
}

const holds = (wide, high) => wide >= needs.least_width && high >= needs.least_height;

/** What cannot be helped here, as the server would say it; or that the window could be larger. A zoomed page may stay. */
function problem() {
  const [wide, high] = [Math.max(innerWidth, screen.width), Math.max(innerHeight, screen.height)];
  if (!needs.phones && innerWidth <= NARROW && (coarse || wide <= NARROW)) return say("use_computer");
  if (!holds(wide, high)) return say("use_larger", { ...needs, width: wide, height: high });
  return holds(innerWidth, innerHeight) ? "" : say("could_be_larger", { ...needs, width: innerWidth, height: innerHeight });
}

function measured() {
  return {
    viewport: `${innerWidth}x${innerHeight}`,
    screen: `${screen.width}x${screen.height}`,
    pixel_ratio: devicePixelRatio,
    touch: coarse,
  };
}

for (const form of document.querySelectorAll("main form")) {
  form.addEventListener("formdata", ({ formData }) => {
    for (const [name, value] of Object.entries(measured())) formData.set(name, value);
  });
  const again = Number(form.dataset.again);
  if (again) setTimeout(() => form.requestSubmit(), again * 1000);
}
addEventListener("resize", look);
addEventListener("pageshow", (event) => event.persisted && location.reload());
look();
