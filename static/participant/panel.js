// The paper card over ten empty tiles: drawing, connection lost, the wish to stop.

import { byId, say, wait } from "./page.js";

const APPEARS = 400;
const STAYS = 400;

export class Panel {
  constructor(outbox) {
    this.root = byId("panel");
    this.title = this.root.querySelector("h2");
    this.lead = this.root.querySelector(".panel-lead");
    this.closing = this.root.querySelector(".panel-close");
    this.segments = [...this.root.querySelectorAll(".segments i")];
    this.nextTry = this.root.querySelector(".next-try");
    this.shownAt = null;
    byId("try-now").addEventListener("click", () => outbox.tryNow());
  }

  /** Show "drawing" unless the faces are there 400 ms after the pause between two generations. */
  expectDrawing(pause = 0) {
    clearTimeout(this.timer);
    this.progress(0);
    this.timer = setTimeout(() => this.#open("drawing", { title: say("drawing"), lead: say("drawing_text") }), pause + APPEARS);
  }

  progress(ready) {
    this.segments.forEach((segment, index) => segment.classList.toggle("done", index < ready));
  }

  /** What happened, that the answer is safe, what happens next. */
  showLost({ title, lead, close }) {
    clearTimeout(this.timer);
    this.closing.textContent = close;
    const shown = !this.root.hidden && this.root.classList.contains("offline");
    if (!shown || this.title.textContent !== title) this.#open("offline", { title, lead });
  }

  countDown(seconds) {
    this.nextTry.textContent = seconds ? say("next_try", { count: seconds }) : say("trying");
  }

  /** A panel that has appeared stays long enough to be read. */
  async close() {
    clearTimeout(this.timer);
    if (this.shownAt !== null) await wait(Math.max(0, STAYS - (performance.now() - this.shownAt)));
  }

  hide() {
    clearTimeout(this.timer);
    this.root.hidden = true;
    this.shownAt = null;
  }

  #open(kind, { title, lead }) {
    this.root.classList.toggle("offline", kind === "offline");
    this.root.hidden = false;
    this.shownAt = performance.now();
    this.title.textContent = title;
    this.lead.textContent = lead;
  }
}
