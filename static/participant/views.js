// Which tiles have been in view. Where the page scrolls, the button leads to the last row before it becomes "Next faces".

import { byId, say } from "./page.js";

const above = () => document.querySelector(".question");
const below = () => document.querySelector(".footer");
// The layouts of static/phone.css, and of a low window in evolve.css.
const SCROLLS = matchMedia("(max-width: 767px), (max-height: 529px)");
const LOOSE = matchMedia("(max-height: 559px)");
const SEEN = 0.75;
const FILLS = 0.6;
const STEPS = [0.25, 0.4, 0.5, 0.6, 0.7, SEEN, 1];

export class Views {
  constructor(grid, record, changed) {
    this.grid = grid;
    this.record = record;
    this.changed = changed;
    this.seen = new Set();
    this.observer = null;
    for (const query of [SCROLLS, LOOSE]) query.addEventListener("change", () => this.#watch());
  }

  /** Ten new faces: nothing has been seen yet. */
  begin() {
    this.seen.clear();
    this.#watch();
  }

  get allSeen() {
    return !SCROLLS.matches || !this.#unseen();
  }

  scrollOn() {
    const covered = sticky(above()) + sticky(below());
    const behavior = matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth";
    const { scrollHeight } = document.documentElement;
    // At the end, with faces passed over too quickly: back to them.
    if (scrollY + innerHeight >= scrollHeight - 2) this.#unseen()?.root.scrollIntoView({ block: "center", behavior });
    else scrollBy({ top: Math.max(200, innerHeight - covered - 40), behavior });
  }

  #unseen() {
    return this.grid.tiles.slice(-2).find((tile) => !this.seen.has(tile));
  }

  #watch() {
    this.observer?.disconnect();
    // What lies under the sticky question and the dock is not in view.
    const margins = `-${sticky(above())}px 0px -${sticky(below())}px 0px`;
    this.observer = new IntersectionObserver((entries) => this.#note(entries), { threshold: STEPS, rootMargin: margins });
    for (const { root } of this.grid.tiles) this.observer.observe(root);
  }

  #note(entries) {
    if (!Number.isFinite(this.grid.onset)) return;
    for (const entry of entries) {
      const { target, time } = entry;
      const tile = this.grid.tileOf(target);
      if (!inView(entry) || this.seen.has(tile)) continue;
      this.seen.add(tile);
      this.record("first_view", tile.id, { at_ms: Math.max(time, this.grid.onset) });
    }
    this.changed();
  }
}

/** How much a bar covers at the edge of the window: nothing where it scrolls with the page. */
const sticky = (bar) => (getComputedStyle(bar).position === "sticky" ? bar.offsetHeight : 0);

/** Most of the tile is seen, or in a window lower than a tile, most of what fits in. */
function inView({ intersectionRatio, intersectionRect, rootBounds }) {
  return intersectionRatio >= SEEN || (rootBounds !== null && intersectionRect.height >= FILLS * rootBounds.height);
}

/** The main button says what it will do. */
export function label(trial, allSeen) {
  const button = byId("next");
  const key = !allSeen ? "see_all" : !trial.final ? "next" : trial.practice ? "practice_next" : "finish";
  const said = button.querySelector(".said");
  if (said.querySelector(".words").textContent !== say(key)) {
    // Words and arrow are new together: they appear where they belong, nothing moves there.
    const anew = said.cloneNode(true);
    anew.querySelector(".words").textContent = say(key);
    said.replaceWith(anew);
  }
  button.classList.toggle("see-all", !allSeen);
}
