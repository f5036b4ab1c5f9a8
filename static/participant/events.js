// What happened between two answers: each event is kept on the device until the server has it.

import { put, remove, waiting } from "./store.js";
import { uuid } from "./page.js";

const EVERY = 5000;
const AT_MOST = 200;
// A load of the page has its own clock: its events are sent apart from those of another load, in their order.
const LOAD = uuid();

export class Events {
  constructor(address) {
    this.address = address;
    this.context = null;
    this.open = new Map();
    this.timer = 0;
    this.at = 0;
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
    this.at = Math.max(this.at + 1, Date.now());
    const item = { id: event.id, address: this.address, at: this.at, load: LOAD, event };
    this.open.set(item.id, item);
    put("events", item);
    this.timer ||= setTimeout(() => this.flush(), EVERY);
  }

  /** Send first what an earlier page left behind. */
  async collectLeft() {
    const left = await waiting("events", this.address);
    this.open = new Map([...left.map((item) => [item.id, item]), ...this.open]);
    if (this.open.size) await this.flush();
  }

  async flush({ leaving = false } = {}) {
    clearTimeout(this.timer);
    this.timer = 0;
    for (const items of this.#bundles()) {
      if (!(await this.#send(items, leaving)) && !leaving) break;
    }
    if (this.open.size) this.timer ||= setTimeout(() => this.flush(), EVERY);
  }

  /** What waits, a load of the page at a time. */
  #bundles() {
    const loads = new Map();
    for (const item of this.open.values()) loads.set(item.load, [...(loads.get(item.load) ?? []), item]);
    return [...loads.values()].flatMap((items) =>
      Array.from({ length: Math.ceil(items.length / AT_MOST) }, (_, part) => items.slice(part * AT_MOST, (part + 1) * AT_MOST)),
    );
  }

  /** One bundle; of one that is refused, each half: a single wrong event must not take the others with it. */
  async #send(items, keepalive) {
    const status = await this.#post(items, keepalive);
    if (status === 422 && items.length > 1) {
      const middle = Math.ceil(items.length / 2);
      const first = await this.#send(items.slice(0, middle), keepalive);
      return (await this.#send(items.slice(middle), keepalive)) && first;
    }
    if (!status) return false;
    for (const { id } of items) this.open.delete(id);
    await remove("events", items.map(({ id }) => id));
    return true;
  }

  /** The status of the server's last word; 0 when there was none. */
  async #post(items, keepalive) {
    try {
      const response = await fetch(`${this.address}/events`, {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: JSON.stringify({ events: items.map(({ event }) => event) }),
        keepalive,
      });
      if (response.ok) return response.status;
      const later = [408, 429].includes(response.status) || response.status >= 500;
      return !later && (await response.json()).error ? response.status : 0;
    } catch {
      return 0;
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
