// How the person works, for the record and for the focus: the kind of the last input, also on the page before.

import { recall, remember } from "./tab.js";

const HELD = ["Control", "Meta", "Alt", "Shift"];

export function inputKind() {
  const kind = { now: recall("input") ?? (matchMedia("(any-hover: hover)").matches ? "mouse" : "touch") };
  const note = (now) => {
    if (now !== kind.now) remember("input", now);
    kind.now = now;
  };
  addEventListener("pointerdown", (event) => note(event.pointerType || "mouse"), true);
  addEventListener("keydown", (event) => HELD.includes(event.key) || note("keyboard"), true);
  return kind;
}
