// The footer's one line: the count, or what is in the way. Nothing on the page moves.

import { byId, reworded, say } from "./page.js";

const ICONS = { problem: "alert", mark: "tick", lock: "lock" };

export class Status {
  constructor() {
    this.root = byId("status");
    this.text = this.root.querySelector(".words");
    this.use = this.root.querySelector("use");
  }

  /** Say a sentence; `kind` is problem, mark, lock or nothing; `action` adds a button. */
  say(sentence, kind = "", action = null) {
    this.root.className = `status ${kind === "lock" ? "mark lock" : kind}`.trim();
    if (kind) this.use.setAttribute("href", `#i-${ICONS[kind]}`);
    this.text = reworded(this.text, sentence);
    this.root.querySelector("button")?.remove();
    if (action) this.root.append(button(action));
  }

  count(selection) {
    const count = selection.chosen.length;
    if (!count) this.say(say("none"));
    else if (selection.best) this.say(say("best_chosen", { count }));
    else this.say(say(selection.takenBack ? "mark_taken_back" : "mark_closest", { count }));
  }

  missing(selection) {
    const key = selection.missing();
    const sentence = {
      none: () => say("need_one"),
      few: () => say("need", { count: selection.minimum }),
      best: () => say("need_best", { count: selection.chosen.length }),
    }[key];
    this.say(sentence(), "problem");
  }
}

function button({ label, run }) {
  const node = document.createElement("button");
  node.type = "button";
  node.className = "link";
  node.textContent = label;
  node.addEventListener("click", run);
  return node;
}
