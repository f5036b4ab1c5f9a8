// The last page: the code appears only when the server holds every answer; copy, print.

import { address, byId, say, state, word } from "./page.js";
import { forgetDraft } from "./draft.js";
import { Events } from "./events.js";
import { Outbox } from "./outbox.js";
import { remove, waiting } from "./store.js";

for (const button of document.querySelectorAll("[data-copy]")) {
  button.hidden = !navigator.clipboard;
  button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(button.dataset.copy);
    button.querySelector("span").textContent = say("copied");
    setTimeout(() => { button.querySelector("span").textContent = say("copy"); }, 3000);
  });
}

const date = document.querySelector("[data-date]");
if (date) date.textContent = say("finished", { date: new Date().toLocaleDateString(document.documentElement.lang, { dateStyle: "long" }) });

const print = document.querySelector("[data-print]");
if (print) {
  print.hidden = false;
  print.addEventListener("click", () => window.print());
}

async function sendLeft() {
  const left = await waiting("answers", address);
  if (!left.length) return;
  byId("waiting").textContent = say("sending", { count: left.length, word: word(left.length) });
  byId("waiting").hidden = false;
  byId("arrived").hidden = true;
  await new Outbox(address).deliverLeft();
  byId("waiting").hidden = true;
  byId("arrived").hidden = false;
}

remove("marks", [address]);
forgetDraft();

/** Whoever was erased has nothing left to send. */
async function forget() {
  for (const store of ["answers", "events"]) {
    const items = await waiting(store, address);
    await remove(store, items.map(({ id }) => id));
  }
}

function sendEvents() {
  const events = new Events(address);
  return events.collectLeft().then(() => events.flush());
}

if (byId("waiting")) {
  sendLeft();
  sendEvents();
} else if (address && state?.completion?.outcome === "erased") {
  forget();
} else if (address) {
  sendEvents();
}
