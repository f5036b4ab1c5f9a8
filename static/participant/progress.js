// "Generation 3 of 10", its segments, and what Start again would keep.

import { byId, say } from "./page.js";

export class Progress {
  constructor() {
    this.label = document.querySelector("[data-generation]");
    this.segments = [...document.querySelectorAll(".topline .segments i")];
    this.again = byId("again")?.querySelector("[data-again-text]");
    this.openers = document.querySelectorAll("[data-dialog='again']");
  }

  show({ generation, generations, reset }) {
    if (this.label) this.label.textContent = generation ? say("generation", { generation, generations }) : say("first");
    this.segments.forEach((segment, index) => {
      segment.className = index < generation - 1 ? "done" : index === generation - 1 ? "current" : "";
    });
    for (const opener of this.openers) opener.hidden = !reset;
    if (this.again) this.again.textContent = generation ? say("again_text", { count: generation }) : say("again_first");
  }
}
