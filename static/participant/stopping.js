// "Stop taking part" is never lost either: without a connection the wish waits like an answer, in its turn.

import { byId } from "./page.js";
import { onward } from "./onward.js";

/** `noted` is told the wish before it is sent. */
export function stopping(outbox, noted) {
  document.querySelector("[data-stop]")?.addEventListener("submit", async (event) => {
    event.preventDefault();
    const erase = event.submitter?.value === "true";
    byId("stop").close();
    noted(erase);
    await outbox.deliver({ kind: "stop", erase }).catch(() => null);
    await outbox.tidy;
    onward();
  });
}
