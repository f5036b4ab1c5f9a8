// What happened between two answers: each event is kept on the device until the server has it.

import { put, remove, waiting } from "./store.js";
import { uuid } from "./page.js";

const EVERY = 5000;
const AT_MOST = 200;

export class Events {
  constructor(address) {
    this.address = address;
    this.context = null;
    this.open = new Map();
    this.timer = 0;
    this.hiddenSince = document.hidden ? performance.now() : null;
    this.hidden = 0;
    this.#watch();
  }

  /** Name the generation that the following events belong to, and start counting hidden time. */
  begin({ id, attempt, generation }) {
    this.context = { trial: id, attempt, generation };
    this.hidden = 0;
    if (this.hiddenSince !== null) this.hiddenSince = performance.now();
  }

  hiddenFor() {
    const running = this.hiddenSince === null ? 0 : performance.now() - this.hiddenSince;
    return Math.round(this.hidden + running);
  }

  record(type, face, extra = {}) {
    if (!this.context) return;
    const event = { id: uuid(), ...this.context, at_ms: Math.round(extra.at_ms ?? performance.now()), type };
    if (face) event.face = face;
    if (extra.duration_ms !== undefined) event.duration_ms = Math.round(extra.duration_ms);
    const item = { id: event.id, address: this.address, at: Date.now() + this.open.size / 1000, event };
    this.open.set(item.id, item);
    put("events", item);
    this.timer ||= setTimeout(() => this.flush(), EVERY);
  }

  async collectLeft() {
    for (const item of await waiting("events", this.address)) this.open.set(item.id, item);
    if (this.open.size) this.timer ||= setTimeout(() => this.flush(), EVERY);
  }

  async flush({ leaving = false } = {}) {
    clearTimeout(this.timer);
    this.timer = 0;
    const items = [...this.open.values()].slice(0, AT_MOST);
    if (!items.length) return;
    const sent = await this.#post(items, leaving);
    if (sent) {
      for (const { id } of items) this.open.delete(id);
      await remove("events", items.map(({ id }) => id));
    }
    if (this.open.size) this.timer ||= setTimeout(() => this.flush(), EVERY);
  }

  async #post(items, keepalive) {
    try {
      const response = await fetch(`${this.address}/events`, {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: JSON.stringify({ events: items.map(({ event }) => event) }),
        keepalive,
      });
      // A batch that the server will never take is dropped; anything else waits for the next try.
      return response.ok || (response.status >= 400 && response.status < 500 && response.status !== 429);
    } catch {
      return false;
    }
  }

  #watch() {
    document.addEventListener("visibilitychange", () => {
      if (document.hidden) {
        this.hiddenSince = performance.now();
      } else if (this.hiddenSince !== null) {
        this.hidden += performance.now() - this.hiddenSince;
        this.hiddenSince = null;
      }
      this.record(document.hidden ? "hidden" : "visible");
      if (document.hidden) this.flush({ leaving: true });
    });
    addEventListener("blur", () => this.record("blur"));
    addEventListener("focus", () => this.record("focus"));
    addEventListener("pagehide", () => this.flush({ leaving: true }));
  }
}
