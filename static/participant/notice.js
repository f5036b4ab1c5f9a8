// What is said on a form while its answer, or the wish to stop, waits for the connection: in a box below the buttons.

import { say } from "./page.js";

/** Return what tells the seconds until the next try. `stop` names the sentence about a wish to stop. */
export function notice(form, outbox, stop = null) {
  document.querySelector(".offline-box")?.remove();
  const box = document.getElementById("offline-box").content.firstElementChild.cloneNode(true);
  const [title, text, close, countdown] = ["h2", ".text", ".close", ".next-try"].map((part) => box.querySelector(part));
  box.querySelector("button").addEventListener("click", () => outbox.tryNow());
  close.textContent = stop ? say(stop) : "";
  return (seconds) => {
    if (!box.isConnected) {
      form.querySelector(".actions").after(box);
      box.scrollIntoView({ block: "nearest" });
    }
    const told = stop ? stopNoted(outbox) : lost(outbox);
    // Only what changes is said again.
    if (title.textContent !== told.title) title.textContent = told.title;
    if (text.textContent !== told.text) text.textContent = told.text;
    countdown.textContent = seconds ? say("next_try", { count: seconds }) : say("trying");
  };
}

const lost = ({ kept, busy }) => ({ title: say(kept ? "offline" : "offline_page"), text: say(busy ? "busy_text" : "offline_text") });

const stopNoted = ({ kept }) => ({ title: say("stop_noted"), text: say(kept ? "stop_noted_text" : "stop_noted_page") });
