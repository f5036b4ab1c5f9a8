// The study editor. The form works by its buttons; this counts what is not saved, adds rows without a reload, asks
// before leaving, and lets the portrait follow the sliders.

import { beginPortrait, letPortraitFollow } from "./portrait.js";
import { letRowsComeAndGo } from "./rows.js";
import { letSectionsFollow } from "./sections.js";
import { countUnsaved, guardLeaving } from "./unsaved.js";

const form = document.querySelector("#editor");

/** After rows have come or gone. */
function anew() {
  countUnsaved(form);
  beginPortrait(form);
}

letPortraitFollow(form);
letRowsComeAndGo(form, anew);
letSectionsFollow(form);
guardLeaving(form);
form.addEventListener("input", () => countUnsaved(form));
form.addEventListener("editor:changed", () => countUnsaved(form));
anew();

// The server says UTC; whoever sits here has a clock of their own.
const time = form.querySelector("time");
const when = new Date(time.dateTime);
const today = when.toDateString() === new Date().toDateString();
time.textContent = when.toLocaleString("en-GB", today
  ? { hour: "2-digit", minute: "2-digit" }
  : { hour: "2-digit", minute: "2-digit", day: "numeric", month: "short" });

const summary = document.querySelector("#summary");
const focus = form.dataset.focus && document.getElementById(`f-${form.dataset.focus.replaceAll(".", "-")}`);
if (summary) summary.focus();
else if (focus) focus.focus();
