// The ten tiles: puts pictures in, empties them, shows what is selected. One tab stop, which moves with the focus.

export class Grid {
  constructor(root) {
    this.root = root;
    this.tiles = [...root.querySelectorAll(".tile")].map(tileOf);
    this.onset = Infinity;
    // Each mark is its own group: a group of radios would be a second tab stop with its own arrow keys.
    for (const [index, tile] of this.tiles.entries()) tile.best.name = `best-${index + 1}`;
    this.move(0);
  }

  get current() {
    return this.tiles[this.at];
  }

  /** Input within the first 250 ms belongs to the faces before. */
  get accepting() {
    return performance.now() - this.onset >= 250;
  }

  tileOf(node) {
    return this.tiles.find(({ root }) => root.contains(node));
  }

  of(face) {
    return this.tiles.find((tile) => tile.id === face);
  }

  empty() {
    this.onset = Infinity;
    this.root.classList.remove("shown");
    this.root.classList.add("empty");
    for (const tile of this.tiles) {
      tile.select.checked = tile.best.checked = false;
      tile.select.disabled = true;
    }
  }

  /** Put ten decoded pictures in, all within one frame; `onset` is told when it was painted. */
  show(faces, images) {
    faces.forEach((face, index) => {
      const tile = this.tiles[index];
      tile.id = tile.root.dataset.face = tile.select.value = tile.best.value = face.id;
      tile.select.disabled = false;
      tile.image.replaceWith(images[index]);
      tile.image = images[index];
    });
    this.root.classList.remove("empty");
    this.root.classList.add("shown");
    this.move(0);
  }

  render(selection) {
    for (const tile of this.tiles) {
      tile.select.checked = selection.has(tile.id);
      tile.best.checked = selection.best === tile.id;
    }
    this.move(this.at);
  }

  /** Make a tile the grid's one tab stop. */
  move(index, { focus = false } = {}) {
    this.at = index;
    this.tiles.forEach(({ select, best, enlarge }, other) => {
      const stop = other === index ? 0 : -1;
      select.tabIndex = enlarge.tabIndex = stop;
      best.tabIndex = select.checked ? stop : -1;
    });
    if (focus) this.current.select.focus();
  }

  /** To the mark of a chosen face. */
  focusBest(face) {
    const tile = this.of(face);
    this.move(this.tiles.indexOf(tile));
    tile.best.focus();
  }

  columns() {
    const top = this.tiles[0].root.offsetTop;
    return this.tiles.findIndex(({ root }) => root.offsetTop !== top) > 0
      ? this.tiles.findIndex(({ root }) => root.offsetTop !== top)
      : this.tiles.length;
  }
}

function tileOf(root) {
  const find = (selector) => root.querySelector(selector);
  return {
    root,
    id: root.dataset.face,
    select: find(".select"),
    best: find(".best"),
    face: find(".face"),
    strip: find(".strip"),
    enlarge: find(".enlarge"),
    image: find("img"),
  };
}
