// Which faces are chosen and which one is best: plain state and its rules, no page.

export class Selection {
  #past = [];

  constructor({ minimum, maximum }, record = () => {}) {
    this.minimum = minimum;
    this.maximum = maximum;
    this.record = record;
    this.chosen = [];
    this.best = null;
    this.automatic = false;
    this.takenBack = false;
  }

  /** What a reload of the page must not lose. */
  get marks() {
    const { chosen, best, automatic, takenBack } = this;
    return { chosen, best, automatic, takenBack, past: this.#past };
  }

  /** Go on from marks that were made before the page was loaded again; nothing is recorded, they were. */
  restore({ past, ...marks }) {
    Object.assign(this, marks);
    this.#past = past;
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  has(face) {
    return this.chosen.includes(face);
  }

  /** Choose a face or take it back; false when there are too many already. */
  toggle(face) {
    if (!this.has(face)) return this.#choose(face, () => this.#settle());
    this.#remember();
    this.chosen = this.chosen.filter((other) => other !== face);
    this.record("deselect", face);
    this.takenBack = this.best === face && !this.automatic && this.chosen.length > 0;
    if (this.best === face) this.#mark(null, false);
    this.#settle();
    return true;
  }

  /** Mark a face as best, choosing it if need be; false when there are too many already. */
  mark(face) {
    const setMark = () => {
      this.#mark(face, false);
      this.record("best", face);
    };
    if (!this.has(face)) return this.#choose(face, setMark);
    if (this.best === face && !this.automatic) return true;
    this.#remember();
    setMark();
    return true;
  }

  undo() {
    const before = this.#past.pop();
    if (!before) return false;
    Object.assign(this, before, { takenBack: false });
    this.record("undo");
    return true;
  }

  /** What is missing before the next faces: "none", "few", "best" or null. */
  missing() {
    if (this.chosen.length < this.minimum) return this.minimum === 1 ? "none" : "few";
    return this.best === null ? "best" : null;
  }

  #choose(face, then) {
    const swap = this.maximum === 1 && this.chosen.length === 1;
    if (this.chosen.length >= this.maximum && !swap) return false;
    this.#remember();
    if (swap) this.record("deselect", this.chosen.pop());
    this.chosen = [...this.chosen, face];
    this.takenBack = false;
    this.record("select", face);
    then();
    return true;
  }

  /** One face alone is best by definition; a second one takes that automatic mark back. */
  #settle() {
    const [only] = this.chosen;
    if (this.chosen.length === 1 && this.best !== only) this.#mark(only, true);
    else if (this.chosen.length > 1 && this.automatic) this.#mark(null, false);
  }

  #mark(face, automatic) {
    this.best = face;
    this.automatic = automatic;
    if (face) this.takenBack = false;
  }

  #remember() {
    this.#past.push({ chosen: [...this.chosen], best: this.best, automatic: this.automatic });
  }
}
