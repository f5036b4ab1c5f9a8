// Mouse and touch on a tile. The first tap acts at once, on release; a second one within 300 ms marks as best; holding a
// finger still for 450 ms enlarges.

const DOUBLE = 300;
const HOLD = 450;
const STILL = 10;

export function pointer(grid, act) {
  let last = { tile: null, at: -Infinity };
  let press = null;
  let held = false;

  const forget = () => {
    clearTimeout(press?.timer);
    press = null;
  };

  grid.root.addEventListener("pointerdown", (event) => {
    forget();
    held = false;
    const tile = event.target.closest(".face") && grid.tileOf(event.target);
    if (!tile || event.pointerType === "mouse" || !event.isPrimary) return;
    const timer = setTimeout(() => {
      held = true;
      act.enlarge(tile);
    }, HOLD);
    press = { x: event.clientX, y: event.clientY, timer };
  });
  addEventListener("pointermove", (event) => {
    if (press && Math.hypot(event.clientX - press.x, event.clientY - press.y) > STILL) forget();
  });
  for (const type of ["pointerup", "pointercancel"]) addEventListener(type, forget);

  // A finger lifted after a hold still clicks: on the tile, or on the enlarged view that opened under it.
  addEventListener("click", (event) => {
    if (!held) return;
    held = false;
    event.preventDefault();
    event.stopImmediatePropagation();
  }, true);

  grid.root.addEventListener("click", (event) => {
    const tile = grid.tileOf(event.target);
    if (!tile) return;
    if (event.target.closest(".enlarge")) {
      act.enlarge(tile);
    } else if (event.target.closest(".strip")) {
      event.preventDefault();
      act.mark(tile, event);
    } else if (event.target.closest(".face")) {
      event.preventDefault();
      const again = last.tile === tile && event.timeStamp - last.at <= DOUBLE;
      last = again ? { tile: null, at: -Infinity } : { tile, at: event.timeStamp };
      if (again) act.mark(tile, event);
      else act.toggle(tile, event);
    }
  });

  // The native controls themselves: Space, and whatever an assistive technology sends.
  grid.root.addEventListener("change", ({ target }) => {
    const tile = grid.tileOf(target);
    if (target === tile?.select) act.toggle(tile);
    if (target === tile?.best) act.mark(tile);
  });

  for (const type of ["contextmenu", "dragstart"]) grid.root.addEventListener(type, (event) => event.preventDefault());
}
