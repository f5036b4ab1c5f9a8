// The evolve page: ten faces, a choice, the next ten. This module joins the others; each of them knows one thing.

import { address, byId, frame, say, state as firstState, word } from "./page.js";
import { dialogs } from "./dialog.js";
import { Enlarged } from "./enlarge.js";
import { Events } from "./events.js";
import { Grid } from "./grid.js";
import { keyboard } from "./keyboard.js";
import { Outbox, Refused } from "./outbox.js";
import { Panel } from "./panel.js";
import { inputKind, pointer } from "./pointer.js";
import { draw } from "./portraits.js";
import { Progress } from "./progress.js";
import { Selection } from "./selection.js";
import { Status } from "./status.js";
import { label, Views } from "./views.js";

const OFFLINE_AFTER = 2000;

class Evolve {
  constructor() {
    this.input = inputKind();
    this.outbox = new Outbox(address);
    this.events = new Events(address);
    this.grid = new Grid(byId("grid"));
    this.status = new Status();
    this.panel = new Panel(this.outbox);
    this.progress = new Progress();
    this.selection = null;
    this.trial = null;
    this.busy = true;
    const record = (type, face, extra) => this.events.record(type, face, extra);
    this.record = record;
    const act = {
      toggle: (tile) => this.#choose(tile, "toggle"),
      mark: (tile) => this.#choose(tile, "mark"),
      undo: () => this.#undo(),
      enlarge: (tile) => this.#ready() && this.enlarged.show(tile),
      next: () => this.#next(),
    };
    this.views = new Views(this.grid, record, () => label(this.trial, this.views.allSeen));
    this.enlarged = new Enlarged(this.grid, () => this.selection, act, record);
    pointer(this.grid, act);
    keyboard(this.grid, act);
    dialogs();
    this.#listen(act);
  }

  async start() {
    this.#hold(true);
    this.events.collectLeft();
    this.#expectReply(firstState.trial);
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
    this.#render();
    if (allowed && !done) this.status.say(say("limit", { count: this.selection.maximum }), "problem");
  }

  #undo() {
    if (this.#ready() && this.selection.undo()) this.#render();
  }

  #render({ quiet = false } = {}) {
    if (!this.selection) return;
    const undo = byId("undo");
    const focused = document.activeElement === undo;
    this.grid.render(this.selection);
    this.enlarged.render();
    undo.hidden = !this.selection.canUndo;
    if (focused && undo.hidden) this.grid.current.select.focus();
    if (!quiet) this.status.count(this.selection);
  }

  #next() {
    if (!this.#ready()) return;
    if (!this.views.allSeen) this.views.scrollOn();
    else if (this.selection.missing()) this.#sayMissing();
    else this.#answer(this.#choice());
  }

  #sayMissing() {
    const missing = this.selection.missing();
    this.status.missing(this.selection);
    const tile = missing === "best" ? this.grid.of(this.selection.chosen[0]) : this.grid.current;
    this.grid.move(this.grid.tiles.indexOf(tile));
    (missing === "best" ? tile.best : tile.select).focus();
  }

  #choice() {
    const tile = this.grid.tiles[0].root.getBoundingClientRect();
    return {
      kind: "choice",
      ...this.#step(),
      selected: this.selection.chosen,
      elite: this.selection.best,
      timing: { ...this.timing, chosen_ms: Math.round(performance.now()), hidden_ms: this.events.hiddenFor() },
      client: {
        viewport: [innerWidth, innerHeight],
        pixel_ratio: devicePixelRatio,
        tile: [Math.round(tile.width), Math.round(tile.height)],
        input: this.input.now,
      },
    };
  }

  #step() {
    const { id, attempt, generation } = this.trial;
    return { trial: id, attempt, generation };
  }

  async #answer(answer) {
    this.answeredAt = performance.now();
    this.#hold(true);
    this.grid.empty();
    this.#expectReply(this.trial);
    const made = this.trial;
    try {
      const reply = await this.outbox.deliver(answer);
      this.status.say(made.generation ? say("saved", { generation: made.generation }) : say("saved_first"), "mark");
      await this.#take(reply, answer.kind === "reset" ? "started_again" : null);
    } catch (problem) {
      if (!(problem instanceof Refused)) throw problem;
      await this.#recover("refused");
    }
  }

  /** Go to where the server is. */
  async #recover(note) {
    const response = await fetch(`${address}/state`, { cache: "no-store" }).catch(() => null);
    if (!response?.ok) return location.reload();
    return this.#take({ state: await response.json() }, note);
  }

  /** While a reply is due: "drawing" after 400 ms, "connection lost" after 2 s with a failure. */
  #expectReply(trial) {
    const since = performance.now();
    this.offline = null;
    this.panel.expectDrawing();
    this.outbox.onwaiting = (seconds) => {
      this.panel.countDown(seconds);
      this.offline ??= setTimeout(() => this.#showOffline(trial), OFFLINE_AFTER - (performance.now() - since));
    };
  }

  #showOffline({ generation }) {
    this.panel.showOffline(generation ? say("offline_close", { generation }) : say("offline_close_plain"));
    this.status.say(generation ? say("kept", { generation }) : say("answer_kept"), "lock");
  }

  async #take({ state, stale, recovered }, note = null) {
    clearTimeout(this.offline);
    this.outbox.onwaiting = null;
    const { trial } = state;
    if (trial?.id !== firstState.trial.id) {
      this.events.flush({ leaving: true });
      await this.outbox.tidy;
      return location.replace(address);
    }
    if (recovered) this.status.say(say("online"), "mark");
    await this.#present(trial, stale ? "elsewhere" : recovered ? "online" : note);
  }

  async #present(trial, note, fresh = false) {
    this.trial = trial;
    this.progress.show(trial);
    const requested = performance.now();
    const images = await draw(trial.faces, { fresh, onReady: (ready) => this.panel.progress(ready) });
    const decoded = performance.now();
    const failed = images.filter((image) => !image).length;
    if (failed) return this.#failed(failed, trial, note);
    await this.panel.close();
    const onset = await frame();
    this.#show(trial, images, { requested, decoded, onset });
    if (note) this.status.say(say(note), note === "refused" ? "problem" : "mark");
    return undefined;
  }

  #failed(count, trial, note) {
    this.panel.hide();
    const run = () => {
      removeEventListener("online", run);
      this.status.say("");
      this.panel.expectDrawing();
      this.#present(trial, note, true);
    };
    this.status.say(say("failed", { count, word: word(count) }), "problem", { label: say("redraw"), run });
    addEventListener("online", run, { once: true });
  }

  /** The one frame in which everything changes. */
  #show(trial, images, { requested, decoded, onset }) {
    this.panel.hide();
    this.selection = new Selection(trial, this.record);
    this.grid.show(trial.faces, images, onset);
    this.timing = { requested_ms: Math.round(requested), decoded_ms: Math.round(decoded), onset_ms: Math.round(onset) };
    this.events.begin(trial);
    this.record("onset", null, { at_ms: onset });
    this.#hold(false);
    this.#render();
    scrollTo(0, 0);
    this.views.begin();
    label(trial, this.views.allSeen);
    if (this.input.now === "keyboard") this.grid.move(0, { focus: true });
    this.#measure("emogen-faces", requested, decoded);
    if (this.answeredAt) this.#measure("emogen-turnaround", this.answeredAt, decoded);
  }

  /** For the developer tools and the bench: nothing else reads it. */
  #measure(name, start, end) {
    performance.measure(name, { start, end });
  }

  #hold(busy) {
    this.busy = busy;
    byId("undo").hidden = true;
    for (const button of document.querySelectorAll(".footer .button, .menu [data-dialog='again']")) {
      button.setAttribute("aria-disabled", String(busy));
    }
  }

  #listen(act) {
    byId("choice").addEventListener("submit", (event) => {
      event.preventDefault();
      act.next();
    });
    byId("undo").addEventListener("click", act.undo);
    document.querySelector("[data-again]")?.addEventListener("submit", (event) => {
      event.preventDefault();
      byId("again").close();
      if (this.#ready()) this.#answer({ kind: "reset", ...this.#step() });
    });
    // Back from another page: what this one remembers may be long over.
    addEventListener("pageshow", (event) => event.persisted && location.reload());
  }
}

new Evolve().start();
