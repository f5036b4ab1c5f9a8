// The evolve page: ten faces, a choice, the next ten. This module joins the others; each of them knows one thing.

import { address, byId, painted, say, state as firstState, wait } from "./page.js";
import { choice, measured, times } from "./choice.js";
import { dialogs } from "./dialog.js";
import { Enlarged } from "./enlarge.js";
import { Events } from "./events.js";
import { Grid } from "./grid.js";
import { inputKind } from "./input.js";
import { keyboard } from "./keyboard.js";
import { Marks } from "./marks.js";
import { currentState, onward } from "./onward.js";
import { Outbox, Refused } from "./outbox.js";
import { Panel } from "./panel.js";
import { pointer } from "./pointer.js";
import { draw, drawnFor } from "./portraits.js";
import { Progress } from "./progress.js";
import { offerAgain } from "./redraw.js";
import { Selection } from "./selection.js";
import { Status } from "./status.js";
import { stopping } from "./stopping.js";
import { label, Views } from "./views.js";
import { Waiting } from "./waiting.js";

class Evolve {
  constructor() {
    this.input = inputKind();
    this.outbox = new Outbox(address);
    this.events = new Events(address);
    this.marks = new Marks(address);
    this.grid = new Grid(byId("grid"));
    this.status = new Status();
    this.waiting = new Waiting(this.outbox, new Panel(this.outbox), this.status);
    this.panel = this.waiting.panel;
    this.progress = new Progress();
    this.none = byId("none");
    this.selection = this.trial = this.answeredAt = null;
    this.busy = true;
    this.stopped = false;
    this.record = (type, face, extra) => this.events.record(type, face, extra);
    const act = {
      toggle: (tile) => this.#choose(tile, "toggle"),
      mark: (tile) => this.#choose(tile, "mark"),
      undo: () => this.#ready() && this.selection.undo() && this.#changed(),
      enlarge: (tile) => this.#ready() && this.enlarged.show(tile),
      next: () => this.#next(),
    };
    this.views = new Views(this.grid, this.record, () => label(this.trial, this.views.allSeen));
    this.enlarged = new Enlarged(this.grid, () => this.selection, act, this.record);
    pointer(this.grid, act);
    keyboard(this.grid, act);
    dialogs();
    stopping(this.outbox, (erase) => this.#stop(erase));
    this.#listen(act);
  }

  async start() {
    this.#hold(true);
    this.events.collectLeft();
    this.waiting.begin(firstState.trial);
    // What was left behind moved the server on: the state in the page is from before.
    if (await this.outbox.deliverLeft()) await this.#recover("online");
    else await this.#take({ state: firstState });
  }

  #ready() {
    return !this.busy && this.grid.accepting;
  }

  #choose(tile, how) {
    const allowed = this.#ready();
    const done = allowed && this.selection[how](tile.id);
    if (allowed) this.grid.move(this.grid.tiles.indexOf(tile));
    if (!this.enlarged.open && allowed && !tile.root.contains(document.activeElement)) tile.select.focus({ preventScroll: true });
    this.#changed();
    if (allowed && !done) this.status.say(say("limit", { count: this.selection.maximum }), "problem");
  }

  #noneIsClose() {
    if (!this.#ready()) {
      this.none.checked = !this.none.checked;
      return;
    }
    this.#changed();
    if (this.none.checked) this.status.say(say("none_noted"), "mark");
  }

  #changed() {
    this.#render();
    if (this.selection && !this.busy) this.marks.keep(this.trial, { ...this.selection.marks, none: this.none?.checked ?? false });
  }

  #render() {
    if (!this.selection) return;
    const undo = byId("undo");
    const focused = document.activeElement === undo;
    this.grid.render(this.selection);
    this.enlarged.render();
    undo.hidden = !this.selection.canUndo;
    if (focused && undo.hidden) this.grid.current.select.focus();
    this.status.count(this.selection);
  }

  #next() {
    if (!this.#ready()) return;
    if (!this.views.allSeen) this.views.scrollOn();
    else if (this.selection.missing()) this.#sayMissing();
    else this.#answer(this.#choice());
  }

  #sayMissing() {
    this.status.missing(this.selection);
    if (this.selection.missing() === "best") this.grid.focusBest(this.selection.chosen[0]);
    else this.grid.current.select.focus();
  }

  #choice() {
    const { shown, none, grid, events, input } = this;
    return choice(this.trial, this.selection, { shown, none, grid, hidden: events.hiddenFor(), input: input.now });
  }

  async #answer(answer) {
    this.answeredAt = performance.now();
    this.#hold(true);
    this.#clear();
    const made = this.trial;
    this.waiting.begin(made, made.pause_ms);
    try {
      const reply = await this.outbox.deliver(answer);
      this.status.say(made.generation ? say("saved", { generation: made.generation }) : say("saved_first"), "mark");
      await this.#take(reply, answer.kind === "reset" ? "started_again" : null);
    } catch (problem) {
      if (!(problem instanceof Refused)) throw problem;
      await this.#recover("refused");
    }
  }

  #clear() {
    this.grid.empty();
    if (this.none) this.none.checked = false;
  }

  /** Go to where the server is. */
  async #recover(note) {
    await this.#take({ state: await currentState() }, note);
  }

  async #take({ state, stale, recovered }, note = null) {
    if (this.stopped) return undefined;
    this.waiting.end();
    const { trial } = state;
    if (trial?.id !== firstState.trial.id) {
      this.events.flush({ leaving: true });
      await this.outbox.tidy;
      return onward();
    }
    if (recovered) this.status.say(say("online"), "mark");
    return this.#present(trial, stale ? "elsewhere" : recovered ? "online" : note);
  }

  async #present(trial, note, fresh = false) {
    this.trial = trial;
    this.progress.show(trial);
    const requested = performance.now();
    const before = this.marks.found(trial);
    const images = await draw(trial.faces, { fresh, onReady: (ready) => this.panel.progress(ready) });
    const decoded = performance.now();
    const failed = images.filter((image) => !image).length;
    if (failed) return this.#failed(failed, trial, note);
    const marks = await before;
    await Promise.all([this.panel.close(), this.#pause(trial)]);
    if (this.stopped) return undefined;
    const onset = await painted(() => this.#show(trial, images, marks));
    this.#begin(trial, { requested, decoded, onset, drawn: drawnFor(trial.faces) });
    if (note) this.status.say(say(note), note === "refused" ? "problem" : "mark");
    return undefined;
  }

  /** The screen stays empty between two generations for as long as the study says. */
  #pause({ pause_ms: pause }) {
    return pause && this.answeredAt ? wait(this.answeredAt + pause - performance.now()) : null;
  }

  #failed(count, trial, note) {
    this.panel.hide();
    offerAgain(this.status, count, () => {
      this.panel.expectDrawing();
      this.#present(trial, note, true);
    });
  }

  /** The one frame in which everything changes. */
  #show(trial, images, marks) {
    this.panel.hide();
    this.selection = new Selection(trial, this.record);
    if (marks) this.selection.restore(marks);
    if (this.none) this.none.checked = marks?.none ?? false;
    this.grid.show(trial.faces, images);
    this.#hold(false);
    this.#render();
    scrollTo(0, 0);
  }

  /** Time zero: the faces have been painted. */
  #begin(trial, moments) {
    this.shown = times(moments);
    this.grid.onset = moments.onset;
    this.events.begin(trial);
    this.record("onset", null, { at_ms: moments.onset });
    this.views.begin();
    label(trial, this.views.allSeen);
    if (this.input.now === "keyboard") this.grid.move(this.grid.at, { focus: true });
    measured(this.answeredAt ?? moments.requested, moments);
  }

  #hold(busy) {
    this.busy = busy;
    byId("undo").hidden = true;
    if (this.none) this.none.disabled = busy;
    for (const button of document.querySelectorAll(".footer .button, .menu [data-dialog='again']")) {
      button.setAttribute("aria-disabled", String(busy));
    }
  }

  #stop(erase) {
    this.stopped = true;
    this.#hold(true);
    this.#clear();
    this.status.say("");
    this.waiting.stop(erase);
  }

  #listen(act) {
    byId("choice").addEventListener("submit", (event) => {
      event.preventDefault();
      act.next();
    });
    byId("undo").addEventListener("click", act.undo);
    this.none?.addEventListener("change", () => this.#noneIsClose());
    document.querySelector("[data-again]")?.addEventListener("submit", (event) => {
      event.preventDefault();
      byId("again").close();
      const { id, attempt, generation } = this.trial;
      if (this.#ready()) this.#answer({ kind: "reset", trial: id, attempt, generation });
    });
  }
}

new Evolve().start();
