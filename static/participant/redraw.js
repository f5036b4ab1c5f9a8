// Faces that could not be drawn: said, and tried again by a button, by itself, and when the connection is back.

import { say, word } from "./page.js";

const BY_ITSELF = 15000;

export function offerAgain(status, count, again) {
  const run = () => {
    clearTimeout(later);
    removeEventListener("online", run);
    status.say("");
    again();
  };
  const later = setTimeout(run, BY_ITSELF);
  addEventListener("online", run);
  status.say(say("failed", { count, word: word(count) }), "problem", { label: say("redraw"), run });
}
