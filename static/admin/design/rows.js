// Rows come, go and change places without a reload: the button sends the form as it would without this script, and
// what the server answers takes the place of the sections.

const KEPT = new Set(["save", "changes", "edit"]);

function goesElsewhere(button) {
  return KEPT.has(button.value) || button.name !== "do" || button.value.startsWith("preview");
}

export function letRowsComeAndGo(form, anew) {
  form.addEventListener("submit", async (event) => {
    const button = event.submitter;
    if (!button || goesElsewhere(button)) return;
    event.preventDefault();
    // Another listener guards the page on leaving; this does not leave it.
    event.stopImmediatePropagation();
    if (button.getAttribute("aria-disabled") === "true") return;
    const fresh = await asked(form, button).catch(() => null);
    if (fresh === null) {
      refuse(form);
      return;
    }
    put(form, fresh);
    anew();
  }, { capture: true });
}

/** Send the form by a button; return the page that comes back. */
async function asked(form, button) {
  const body = new FormData(form, button);
  const reply = await fetch(form.action, { method: "POST", body: button.formEnctype === "multipart/form-data" ? body : new URLSearchParams(body) });
  const page = new DOMParser().parseFromString(await reply.text(), "text/html");
  return page.querySelector("#editor");
}

/** Put the sections of a page in the place of those that are here; what was folded open stays so. */
function put(form, fresh) {
  const open = new Set([...form.querySelectorAll("details[open]")].map(place));
  const [here, there] = [".cards", ".cards"].map((part, turn) => (turn ? fresh : form).querySelector(part));
  here.replaceWith(document.adoptNode(there));
  form.querySelector(".sections ul").replaceWith(document.adoptNode(fresh.querySelector(".sections ul")));
  for (const details of form.querySelectorAll("details")) if (open.has(place(details))) details.open = true;
  const focus = fresh.dataset.focus && document.getElementById(`f-${fresh.dataset.focus.replaceAll(".", "-")}`);
  const summary = document.querySelector("#summary");
  const goal = summary ?? firstField(focus) ?? focus;
  goal?.closest("details")?.setAttribute("open", "");
  goal?.focus();
}

/** Which fold this is: its card, its row, and its place among the folds there. */
function place(details) {
  const home = details.closest(".row-card, .panel, .card");
  return `${home?.id} ${[...(home?.querySelectorAll("details") ?? [])].indexOf(details)}`;
}

function firstField(row) {
  return row?.querySelector('input:not([type="hidden"]):not([type="file"]), textarea, select');
}

function refuse(form) {
  const status = form.querySelector("#status");
  status.textContent = "The server cannot be reached. Nothing is lost; try again.";
  status.classList.add("wrong");
}
