// "Generation 3 of 10", or of at most 10 while the last one is not known, its segments, and whether this face may be started again.

import { say } from "./page.js";

export class Progress {
  constructor() {
    this.label = document.querySelector("[data-generation]");
    this.bar = document.querySelector(".topline .segments");
    this.openers = document.querySelectorAll("[data-dialog='again']");
  }

  show({ generation, generations, open, reset }) {
    const counted = () => say(open ? "generation_open" : "generation", { generation, generations });
    if (this.label) this.label.textContent = generation ? counted() : say("first");
    for (const [index, segment] of this.#segments(generations).entries()) {
      segment.className = index < generation - 1 ? "done" : index === generation - 1 ? "current" : "";
    }
    for (const opener of this.openers) opener.hidden = !reset;
  }

  /** One for each generation: fewer once the last one is known, all of them again after a reset. */
  #segments(generations) {
    if (!this.bar) return [];
    while (this.bar.childElementCount > generations) this.bar.lastElementChild.remove();
    while (this.bar.childElementCount < generations) this.bar.append(document.createElement("i"));
    return [...this.bar.children];
  }
}
