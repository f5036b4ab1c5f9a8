// Which tiles have been in view. On a phone the button leads to the last row before it becomes "Next faces".

import { byId, say } from "./page.js";

const PHONE = matchMedia("(max-width: 640px)");

export class Views {
  constructor(grid, record, changed) {
    this.grid = grid;
    this.record = record;
    this.changed = changed;
    this.seen = new Set();
    this.observer = null;
    PHONE.addEventListener("change", () => this.#watch());
  }

  /** Ten new faces: nothing has been seen yet. */
  begin() {
    this.seen.clear();
    this.#watch();
  }

  get allSeen() {
    const { tiles } = this.grid;
    return !PHONE.matches || tiles.slice(-2).every((tile) => this.seen.has(tile));
  }

  scrollOn() {
    const covered = document.querySelector(".question").offsetHeight + document.querySelector(".footer").offsetHeight;
    const smooth = matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth";
    scrollBy({ top: Math.max(200, innerHeight - covered - 40), behavior: smooth });
  }

  #watch() {
    this.observer?.disconnect();
    // What lies under the sticky question and the dock is not in view.
    const margins = PHONE.matches ? "-96px 0px -122px 0px" : "0px";
    this.observer = new IntersectionObserver((entries) => this.#note(entries), { threshold: 0.75, rootMargin: margins });
    for (const { root } of this.grid.tiles) this.observer.observe(root);
  }

  #note(entries) {
    if (!Number.isFinite(this.grid.onset)) return;
    for (const { isIntersecting, target, time } of entries) {
      const tile = this.grid.tileOf(target);
      if (!isIntersecting || this.seen.has(tile)) continue;
      this.seen.add(tile);
      this.record("first_view", tile.id, { at_ms: Math.max(time, this.grid.onset) });
    }
    this.changed();
  }
}

/** The main button says what it will do. */
export function label(trial, allSeen) {
  const button = byId("next");
  const key = !allSeen ? "see_all" : !trial.final ? "next" : trial.practice ? "practice_next" : "finish";
  button.querySelector(".words").textContent = say(key);
  button.classList.toggle("see-all", !allSeen);
}
