// One face on the whole screen: same grey, same framing, with its own keys.

import { keyOf } from "./keyboard.js";
import { byId, say } from "./page.js";

export class Enlarged {
  #since = 0;

  constructor(grid, selection, act, record) {
    this.dialog = byId("enlarged");
    this.frame = this.dialog.querySelector(".enlarged-face");
    this.image = this.frame.querySelector("img");
    Object.assign(this, { grid, selection, act, record, tile: null });
    this.#listen();
  }

  get open() {
    return this.dialog.open;
  }

  show(tile) {
    if (this.tile) this.#end();
    this.tile = tile;
    this.#since = performance.now();
    this.record("enlarge", tile.id);
    this.image.src = tile.image.src;
    if (!this.dialog.open) {
      this.dialog.showModal();
      byId("enlarged-select").focus();
    }
    this.render();
  }

  render() {
    if (!this.tile) return;
    const selection = this.selection();
    const selected = selection.has(this.tile.id);
    const best = selection.best === this.tile.id;
    const at = this.grid.tiles.indexOf(this.tile);
    this.frame.classList.toggle("selected", selected);
    this.frame.classList.toggle("marked-best", best);
    byId("enlarged-place").textContent = say("place", { place: at + 1, places: this.grid.tiles.length });
    press("enlarged-select", selected, say(selected ? "selected" : "select"));
    press("enlarged-best", best, say(best ? "best" : "mark"));
    byId("enlarged-previous").setAttribute("aria-disabled", String(at === 0));
    byId("enlarged-next").setAttribute("aria-disabled", String(at === this.grid.tiles.length - 1));
  }

  #step(by) {
    const tile = this.grid.tiles[this.grid.tiles.indexOf(this.tile) + by];
    if (tile) this.show(tile);
  }

  #end() {
    this.record("enlarge_end", this.tile.id, { duration_ms: performance.now() - this.#since });
  }

  #closed() {
    if (!this.tile) return;
    this.#end();
    const { tile } = this;
    this.tile = null;
    this.grid.move(this.grid.tiles.indexOf(tile), { focus: true });
  }

  #listen() {
    const on = (id, run) => byId(id).addEventListener("click", run);
    on("enlarged-close", () => this.dialog.close());
    on("enlarged-previous", () => this.#step(-1));
    on("enlarged-next", () => this.#step(1));
    on("enlarged-select", () => this.act.toggle(this.tile));
    on("enlarged-best", () => this.act.mark(this.tile));
    this.dialog.addEventListener("close", () => this.#closed());
    this.dialog.addEventListener("keydown", (event) => this.#key(event));
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const forth = getComputedStyle(this.dialog).direction === "rtl" ? -1 : 1;
    const onOther = event.target.closest("#enlarged-close, .round, #enlarged-best");
    const work = {
      ArrowLeft: () => this.#step(-forth),
      ArrowRight: () => this.#step(forth),
      b: () => this.act.mark(this.tile),
      z: () => this.dialog.close(),
      " ": onOther ? null : () => this.act.toggle(this.tile),
    }[keyOf(event)];
    if (!work) return;
    event.preventDefault();
    if (!event.repeat) work();
  }
}

function press(id, pressed, label) {
  const button = byId(id);
  button.setAttribute("aria-pressed", String(pressed));
  button.querySelector("span").textContent = label;
}
