// The editor of heads: fields beside the sliders, and a portrait that follows them. Without this script the form works
// by its buttons.

const PAUSE = 250;
const form = document.querySelector("#editor");
const portrait = document.querySelector("#portrait");
const status = document.querySelector("#status");
const own = document.querySelector("#own_look");

let timer = 0;
let asking = null;
let shown = null;
let painted = null;

function ranges() {
  return form.querySelectorAll(".control > [name]");
}

/** What a slider or colour stands at, short enough to read. */
function rounded(value) {
  return Math.round(value * 100) / 100;
}

/** Whether what is typed beside a slider is a number that the slider can stand at. */
function fits(typed) {
  return typed.value !== "" && typed.validity.valid;
}

function field(input) {
  return input.parentElement.querySelector(".typed");
}

/** Show a control's number, and the way back where it was changed. */
function tell(input) {
  const typed = field(input);
  if (typed && typed !== document.activeElement) {
    typed.value = rounded(input.value);
    typed.removeAttribute("aria-invalid");
  }
  input.parentElement.querySelector(".reset").hidden = input.value === input.dataset.start;
}

function tellShares() {
  const amounts = ["african", "asian", "caucasian"].map((name) => [name, Number(form.elements[name].value)]);
  const total = amounts.reduce((sum, [, amount]) => sum + amount, 0);
  const words = amounts.map(([name, amount]) => `${name} ${Math.round((100 * amount) / total)} %`);
  document.querySelector("#shares").textContent = total > 0 ? words.join(", ") : "Set at least one above 0.";
}

function say(words, wrong = false) {
  status.textContent = words;
  status.classList.toggle("wrong", wrong);
}

/** Draw once the sliders have rested; a change while drawing starts anew. */
function changed() {
  clearTimeout(timer);
  asking?.abort();
  timer = setTimeout(draw, PAUSE);
}

async function draw() {
  const mine = new AbortController();
  asking = mine;
  const begun = performance.now();
  form.classList.add("busy");
  say("Drawing");
  try {
    const reply = await send("/admin/heads/preview", mine.signal);
    await show(await reply.blob());
    name(reply.headers.get("X-Head-Hash"));
    if (!own.checked) wear(JSON.parse(reply.headers.get("X-Head-Look")), true);
    say(`Drawn in ${((performance.now() - begun) / 1000).toFixed(1)} s`);
  } catch (error) {
    if (mine.signal.aborted || error.newer) return;
    say(error.message, true);
  } finally {
    if (asking === mine) form.classList.remove("busy");
  }
}

/** Send the form; a refusal becomes an error in the server's own words. */
async function send(address, signal) {
  const body = new URLSearchParams(new FormData(form));
  let reply;
  try {
    reply = await fetch(address, { method: "POST", body, signal });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new Error("The server cannot be reached. Change a slider to try again.");
  }
  const kind = reply.headers.get("Content-Type") ?? "";
  if (reply.ok && !kind.startsWith("text/html")) return reply;
  if (!kind.startsWith("application/json")) throw new Error("You are signed out, or this page is too old. Reload it.");
  const told = await reply.json();
  throw Object.assign(new Error(told.error.message), { newer: reply.status === 409 });
}

/** Keep the old picture until the new one is ready. */
async function show(blob) {
  const address = URL.createObjectURL(blob);
  const next = new Image();
  next.src = address;
  await next.decode();
  portrait.src = address;
  if (shown) URL.revokeObjectURL(shown);
  shown = address;
}

function name(digest) {
  document.querySelector("#digest").textContent = digest.slice(0, 12);
  document.querySelector("#short").textContent = digest.slice(0, 12);
}

function look() {
  return [...ranges()].filter((input) => input.name.startsWith("look."));
}

/** Set the fields of the look: to what the head wears, or back to what was painted. */
function wear(values, anew = false) {
  for (const input of look()) {
    input.value = values[input.name];
    if (anew) input.dataset.start = input.value;
    tell(input);
  }
}

/** A look of one's own is put away and taken out again; the head's own way shows in between. */
function dress() {
  if (!own.checked) painted = Object.fromEntries(look().map((input) => [input.name, input.value]));
  else if (painted) wear(painted);
}

async function copy() {
  try {
    const reply = await send("/admin/heads/document");
    await navigator.clipboard.writeText(await reply.text());
    say("Document copied");
  } catch (error) {
    say(error.message, true);
  }
}

form.addEventListener("input", (event) => {
  const input = event.target;
  if (input.classList.contains("typed")) {
    if (!fits(input)) return;
    input.removeAttribute("aria-invalid");
    const slider = input.parentElement.querySelector("[name]");
    slider.value = input.value;
    tell(slider);
  } else if (input.type === "range") {
    // A drag stops anywhere; two decimals are enough and can be read.
    input.value = rounded(input.value);
  }
  if (input.closest(".control")) tell(input.parentElement.querySelector("[name]"));
  // Whoever paints wants to see it.
  if (input.name?.startsWith("look.")) own.checked = true;
  if (input === own) dress();
  tellShares();
  if (!["name", "children"].includes(input.name)) changed();
});

form.addEventListener("change", (event) => {
  const input = event.target;
  if (input.classList.contains("typed") && !fits(input)) {
    input.setAttribute("aria-invalid", "true");
    say(`${input.getAttribute("aria-label")}: expected ${input.min} to ${input.max}.`, true);
  }
  // The name is not in the picture, but it is in the hash; nobody waits for that at every letter.
  if (input.name === "name") changed();
});

form.addEventListener("click", (event) => {
  const reset = event.target.closest(".reset");
  if (!reset) return;
  const input = reset.parentElement.querySelector("[name]");
  input.value = input.dataset.start;
  tell(input);
  tellShares();
  input.focus();
  changed();
});

form.addEventListener("submit", (event) => {
  // Enter in any field asks for the first button, which previews.
  if (event.submitter?.hasAttribute("formaction")) return;
  event.preventDefault();
  clearTimeout(timer);
  asking?.abort();
  draw();
});
document.querySelector("#copy").addEventListener("click", copy);

for (const input of ranges()) {
  // Browsers rewrite a value to one that the slider can stand at.
  input.dataset.start = input.value === input.defaultValue ? input.dataset.start : input.value;
  const typed = field(input);
  if (typed) {
    typed.hidden = false;
    typed.disabled = false;
  }
  tell(input);
}
document.querySelector("#copy").hidden = !navigator.clipboard;
tellShares();
