// Keys inside the grid: arrows, Home, End, B, Z, Enter; Ctrl or Cmd with Z anywhere on the page.

export function keyboard(grid, act) {
  grid.root.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const tile = grid.tileOf(event.target);
    const to = tile && destination(event.key, grid);
    if (to !== undefined) {
      event.preventDefault();
      grid.move(to, { focus: true });
    } else if (tile) {
      letter(event, tile, act);
    }
  });
  grid.root.addEventListener("focusin", ({ target }) => {
    const tile = grid.tileOf(target);
    if (tile && tile !== grid.current) grid.move(grid.tiles.indexOf(tile));
  });
  document.addEventListener("keydown", (event) => {
    const undo = (event.ctrlKey || event.metaKey) && !event.shiftKey && keyOf(event) === "z";
    if (!undo || document.querySelector("dialog.dialog[open]")) return;
    event.preventDefault();
    act.undo();
  });
}

/** What a key means: its letter, or where another script is typed, the Latin letter printed beside it. */
export function keyOf({ key, code }) {
  const other = /^Key[A-Z]$/.test(code) && !/^[a-z]$/i.test(key);
  const meant = other ? code.slice(3) : key;
  return meant.length === 1 ? meant.toLowerCase() : meant;
}

function letter(event, tile, act) {
  const onButton = event.target === tile.enlarge;
  const work = {
    b: () => act.mark(tile),
    z: () => act.enlarge(tile),
    Enter: onButton ? null : () => act.next(),
  }[keyOf(event)];
  if (!work) return;
  event.preventDefault();
  if (!event.repeat) work();
}

/** Arrows follow what is seen, also right to left, and stop at the edges. */
function destination(key, grid) {
  const { at } = grid;
  const columns = grid.columns();
  const last = grid.tiles.length - 1;
  const sideways = getComputedStyle(grid.root).direction === "rtl" ? -1 : 1;
  const step = { ArrowLeft: -sideways, ArrowRight: sideways, ArrowUp: -columns, ArrowDown: columns }[key];
  if (key === "Home") return 0;
  if (key === "End") return last;
  if (step === undefined) return undefined;
  const to = at + step;
  const sameRow = Math.floor(to / columns) === Math.floor(at / columns);
  return to < 0 || to > last || (Math.abs(step) === 1 && columns > 1 && !sameRow) ? at : to;
}
