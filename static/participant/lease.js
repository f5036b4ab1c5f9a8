// Asks whether somebody is there before their place is given away. Only the server knows how long that is.

import { address, byId, say } from "./page.js";

const box = byId("lease");
const [status, button] = [box.querySelector("p"), box.querySelector("button")];
const STILL = 4000;
let timer = 0;

async function ask(method) {
  try {
    const reply = await fetch(`${address}/lease`, { method, headers: { Accept: "application/json" } });
    return reply.ok ? await reply.json() : null;
  } catch {
    return null;
  }
}

/** Come back when the place is about to be given away, by what the server says then: an answer has renewed it. */
function watch({ seconds, warning }) {
  clearTimeout(timer);
  const left = seconds - warning;
  timer = setTimeout(look, Math.max(left + 1, 20) * 1000);
}

async function look() {
  const told = await ask("GET");
  if (told) show(told);
  else timer = setTimeout(look, 30_000);
}

function show(told) {
  if (told.seconds > told.warning) {
    hide();
  } else if (told.seconds > 0) {
    tell(say("lease", { count: Math.ceil(told.seconds / 60) }));
    button.hidden = false;
  } else if (!button.hidden) {
    tell(say("lease_over"));
  }
  if (told.seconds > 0) watch(told);
}

function tell(text) {
  box.classList.add("shown");
  if (status.textContent !== text) status.textContent = text;
}

function hide() {
  box.classList.remove("shown");
  status.textContent = "";
  button.hidden = true;
}

button.addEventListener("click", async () => {
  const told = await ask("POST");
  if (!told) return;
  button.hidden = true;
  byId("main").focus({ preventScroll: true });
  tell(say("lease_kept"));
  watch(told);
  setTimeout(() => button.hidden && hide(), STILL);
});

const { lease, warning } = document.body.dataset;
show({ seconds: Number(lease), warning: Number(warning) });
