// What is said while a reply is due: drawing after 400 ms; connection lost after 2 s with a failure, or 4 s of silence.

import { say } from "./page.js";

const AFTER_FAILURE = 2000;
const AFTER_SILENCE = 4000;

export class Waiting {
  constructor(outbox, panel, status) {
    Object.assign(this, { outbox, panel, status, failing: 0, silent: 0 });
  }

  /** The answer of a trial's generation was given; `pause` is how long the screen stays empty in any case. */
  begin(trial, pause = 0) {
    this.end();
    const since = performance.now();
    this.panel.expectDrawing(pause);
    this.silent = setTimeout(() => this.#lost(trial), AFTER_SILENCE);
    this.outbox.onwaiting = (seconds) => {
      this.panel.countDown(seconds);
      this.failing ||= setTimeout(() => this.#lost(trial), AFTER_FAILURE - (performance.now() - since));
    };
  }

  end() {
    clearTimeout(this.failing);
    clearTimeout(this.silent);
    this.failing = this.silent = 0;
    this.outbox.onwaiting = null;
  }

  /** The wish to stop: said at the first failure. */
  stop(erase) {
    this.end();
    this.panel.hide();
    this.outbox.onwaiting = (seconds) => {
      this.panel.countDown(seconds);
      this.panel.showLost({
        title: say("stop_noted"),
        lead: say(this.outbox.kept ? "stop_noted_text" : "stop_noted_page"),
        close: say(erase ? "stop_noted_erase" : "stop_noted_keep"),
      });
    };
  }

  #lost({ generation }) {
    const { kept, busy } = this.outbox;
    const place = generation ? say("offline_close", { generation }) : say("offline_close_plain");
    this.panel.showLost({
      title: say(kept ? "offline" : "offline_page"),
      lead: say(busy ? "busy_text" : "offline_text"),
      close: kept ? place : say("offline_close_page"),
    });
    const here = generation ? say("kept", { generation }) : say("answer_kept");
    this.status.say(kept ? here : say("answer_kept_page"), "lock");
  }
}
