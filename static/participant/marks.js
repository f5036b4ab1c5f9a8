// What was selected and not sent yet, so that a reload of the page loses nothing: one record a participation.

import { put, waiting } from "./store.js";

const of = ({ id, attempt, generation }) => `${id} ${attempt} ${generation}`;

export class Marks {
  constructor(address) {
    this.address = address;
  }

  keep(trial, marks) {
    put("marks", { id: this.address, address: this.address, at: 0, of: of(trial), marks });
  }

  /** The marks of exactly these faces, or null. */
  async found(trial) {
    const [kept] = await waiting("marks", this.address);
    return kept?.of === of(trial) ? kept.marks : null;
  }
}
