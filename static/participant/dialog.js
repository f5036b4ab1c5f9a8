// Help, Stop and Start again: native dialogs; without script the address's fragment opens the same ones.

import { byId } from "./page.js";

export function dialogs() {
  document.addEventListener("click", (event) => {
    const opener = event.target.closest("[data-dialog]");
    const closer = event.target.closest("[data-close]");
    if (opener) {
      event.preventDefault();
      opener.closest("details")?.removeAttribute("open");
      if (opener.getAttribute("aria-disabled") !== "true") show(byId(opener.dataset.dialog));
    } else if (closer) {
      event.preventDefault();
      closer.closest("dialog").close();
    } else {
      const menu = document.querySelector("details.menu[open]");
      if (menu && !menu.contains(event.target)) menu.removeAttribute("open");
    }
  });
  // A key that is held opens a dialog and must not answer it as well.
  document.addEventListener("keydown", (event) => {
    if (event.repeat && event.key === "Enter" && event.target.closest?.("dialog, [data-dialog]")) event.preventDefault();
  });
  // A role=button link also answers to Space.
  document.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.target.getAttribute?.("role") !== "button") return;
    event.preventDefault();
    event.target.click();
  });
  if (location.hash) byId(location.hash.slice(1))?.matches("dialog.dialog") && history.replaceState(null, "", location.pathname);
}

/** Whoever opened a dialog by mistake presses the key again: that carries on. */
function show(dialog) {
  dialog.showModal();
  dialog.querySelector("form [data-close]")?.focus();
}
