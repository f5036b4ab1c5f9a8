// On to where the server is. A page that could not be loaded could not go on by itself, so the server is asked first.

import { secondsAfter } from "./backoff.js";
import { address, wait } from "./page.js";

const PATIENCE = 10000;

/** The server's answer to "where am I?", however long the connection is gone. */
async function reached() {
  for (let failures = 0; ; failures += 1) {
    try {
      const response = await fetch(`${address}/state`, { cache: "no-store", signal: AbortSignal.timeout?.(PATIENCE) });
      if (response.status < 500 && response.status !== 429) return response;
    } catch {
      // Offline: try again.
    }
    await wait(secondsAfter(failures) * 1000);
  }
}

/** The current state; a participation that has none shows its page, which says why. */
export async function currentState() {
  const response = await reached();
  if (response.ok) return response.json();
  location.replace(address);
  return new Promise(() => {});
}

/** Leave this page for that of the current step. */
export async function onward() {
  await reached();
  location.replace(address);
}
