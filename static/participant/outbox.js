// Never lose an answer: it is written to the device under its own id, then sent until the server has answered for good.
// Repeats are harmless, the server knows the id. What is sent goes in turn: nothing overtakes an earlier answer.

import { secondsAfter } from "./backoff.js";
import { put, remove, waiting } from "./store.js";
import { uuid, wait } from "./page.js";

const PATIENCE = 10000;
const AT_MOST = 15;
// Writing takes milliseconds; a device that cannot write must not hold an answer back.
const WRITING = 250;

export class Refused extends Error {}

export class Outbox {
  constructor(address) {
    this.address = address;
    this.failures = 0;
    this.queue = [];
    this.turn = Promise.resolve();
    this.tidy = Promise.resolve();
    // Whether the device has what waits, and whether the server itself said "later".
    this.kept = true;
    this.busy = false;
    // Called with the seconds until the next try, 0 while trying.
    this.onwaiting = null;
    this.at = 0;
    addEventListener("online", () => this.tryNow());
    addEventListener("pagehide", () => this.leave());
    document.addEventListener("visibilitychange", () => document.hidden || this.tryNow());
  }

  /** Keep and send one answer; resolves with the state that follows, {state, stale, recovered}. */
  deliver(answer) {
    answer.id ??= uuid();
    // In the order of this page whatever the clock of the device does.
    this.at = Math.max(this.at + 1, Date.now());
    const item = { id: answer.id, address: this.address, at: this.at, answer };
    const kept = put("answers", item).then((done) => { this.kept = done; });
    return this.#queued(item, kept);
  }

  /** Send what an earlier page left behind; resolves with how many there were. */
  async deliverLeft() {
    const left = await waiting("answers", this.address);
    for (const item of left) await this.#queued(item, null).catch(() => null);
    await this.tidy;
    return left.length;
  }

  tryNow() {
    this.wake?.();
  }

  /** The page goes away: a last try that outlives it. The copy on the device stays until a reply was read. */
  leave() {
    if (!this.queue.length) return;
    const [address, options] = this.#request(this.queue[0].answer);
    fetch(address, { ...options, keepalive: true }).catch(() => {});
  }

  #queued(item, kept) {
    this.queue.push(item);
    const sent = this.turn.then(() => this.#send(item, kept));
    this.turn = sent.catch(() => null);
    return sent;
  }

  async #send(item, kept) {
    this.failures = 0;
    if (kept) await Promise.race([kept, wait(WRITING)]);
    for (;;) {
      const reply = await this.#attempt(item.answer);
      if (reply) {
        this.queue.shift();
        // The next faces do not wait for the device to forget this answer; leaving the page does.
        this.tidy = Promise.resolve(kept).then(() => remove("answers", [item.id]));
        if (reply.refused) throw new Refused(reply.refused);
        return { ...reply, recovered: this.failures > 0 };
      }
      await this.#pause();
    }
  }

  #request({ kind, ...answer }) {
    const [path, body] = kind === "stop" ? ["stop", { erase: answer.erase }] : ["answers", { kind, ...answer }];
    const headers = { "Content-Type": "application/json", Accept: "application/json" };
    return [`${this.address}/${path}`, { method: "POST", headers, body: JSON.stringify(body) }];
  }

  async #attempt(answer) {
    this.busy = false;
    try {
      const [address, options] = this.#request(answer);
      const response = await fetch(address, { ...options, signal: AbortSignal.timeout?.(PATIENCE) });
      this.later = Number(response.headers.get("Retry-After")) || 0;
      this.busy = [408, 429].includes(response.status) || response.status >= 500;
      if (this.busy) return null;
      const body = await response.json();
      if (response.ok) return { state: body, stale: false };
      if (body.state) return { state: body.state, stale: true };
      // What is no refusal of ours comes from something between here and the server.
      return body.error ? { refused: body.error.message } : null;
    } catch {
      return null;
    }
  }

  async #pause() {
    const seconds = this.busy ? Math.min(Math.max(secondsAfter(this.failures), this.later), AT_MOST) : secondsAfter(this.failures);
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
}
