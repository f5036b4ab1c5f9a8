// Never lose an answer: it is written to the device under its own id, then sent until the server has answered for good.
// Repeats are harmless, the server knows the id.

import { put, remove, waiting } from "./store.js";
import { uuid } from "./page.js";

const PAUSES = [1, 2, 4, 8, 15];
const PATIENCE = 15000;

export class Refused extends Error {}

export class Outbox {
  constructor(address) {
    this.address = address;
    this.failures = 0;
    this.sending = null;
    this.tidy = Promise.resolve();
    // Called with the seconds until the next try, 0 while trying.
    this.onwaiting = null;
    addEventListener("online", () => this.tryNow());
    addEventListener("pagehide", () => this.leave());
  }

  /** Keep and send one answer; resolves with the state that follows, {state, stale}. */
  async deliver(answer) {
    const item = { id: uuid(), address: this.address, at: Date.now(), answer };
    answer.id ??= item.id;
    item.id = answer.id;
    this.sending = item;
    // Writing and sending go side by side: a quick server need not wait for the disk.
    const kept = put("answers", item);
    return this.#send(item, kept);
  }

  /** Send what an earlier page left behind; resolves with how many there were. */
  async deliverLeft() {
    const left = await waiting("answers", this.address);
    for (const item of left) {
      this.sending = item;
      await this.#send(item, null).catch(() => null);
    }
    await this.tidy;
    return left.length;
  }

  tryNow() {
    this.wake?.();
  }

  async #send(item, kept) {
    this.failures = 0;
    for (;;) {
      const reply = await this.#attempt(item.answer);
      if (reply) {
        // The next faces do not wait for the device to forget this answer; leaving the page does.
        this.tidy = Promise.resolve(kept).then(() => remove("answers", [item.id]));
        this.sending = null;
        const recovered = this.failures > 0;
        if (reply.refused) throw new Refused(reply.refused);
        return { ...reply, recovered };
      }
      await this.#pause();
    }
  }

  async #attempt(answer) {
    try {
      const response = await fetch(`${this.address}/answers`, {
        method: "POST",
        headers: { "Content-Type": "application/json", Accept: "application/json" },
        body: JSON.stringify(answer),
        signal: AbortSignal.timeout?.(PATIENCE),
      });
      if (response.status === 429 || response.status >= 500) return null;
      const body = await response.json();
      if (response.ok) return { state: body, stale: false };
      if (body.state) return { state: body.state, stale: true };
      return { refused: body.error?.message ?? String(response.status) };
    } catch {
      return null;
    }
  }

  async #pause() {
    const seconds = PAUSES[Math.min(this.failures, PAUSES.length - 1)];
    this.failures += 1;
    for (let left = seconds; left > 0; left -= 1) {
      this.onwaiting?.(left);
      const woken = await new Promise((done) => {
        const timer = setTimeout(() => done(false), 1000);
        this.wake = () => {
          clearTimeout(timer);
          done(true);
        };
      });
      if (woken) break;
    }
    this.wake = null;
    this.onwaiting?.(0);
  }


  /** The page goes away: a last try that outlives it. The copy on the device stays until a reply was read. */
  leave() {
    if (!this.sending) return;
    const body = JSON.stringify(this.sending.answer);
    fetch(`${this.address}/answers`, { method: "POST", headers: { "Content-Type": "application/json" }, body, keepalive: true }).catch(() => {});
  }
}
