// "Generation 3 of 10", its segments, and whether this face may be started again.

import { say } from "./page.js";

export class Progress {
  constructor() {
    this.label = document.querySelector("[data-generation]");
    this.segments = [...document.querySelectorAll(".topline .segments i")];
    this.openers = document.querySelectorAll("[data-dialog='again']");
  }

  show({ generation, generations, reset }) {
    if (this.label) this.label.textContent = generation ? say("generation", { generation, generations }) : say("first");
    this.segments.forEach((segment, index) => {
      segment.className = index < generation - 1 ? "done" : index === generation - 1 ? "current" : "";
    });
    for (const opener of this.openers) opener.hidden = !reset;
  }
}
