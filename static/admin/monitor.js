// Keeps the monitor up to date while somebody looks at it: pieces of the page come by server-sent events and are laid
// over what is there, so that focus, opened tables and scrolling stay. Without this script the page has a Reload link.

const watch = document.querySelector("#watch");
const live = document.querySelector("#live");
const pause = document.querySelector("#pause");
const moment = document.querySelector("#moment");
const age = document.querySelector("#age");

const AGAIN = 15000;
let source = null;
let paused = false;
let ended = false;
let again = 0;
// Between the server's clock and this one: ages are told by the server's.
let ahead = Date.now() - Date.parse(moment.dateTime);

/** Lay new content over old: nodes that are alike stay, so nothing that has not changed is touched. */
export function lay(old, fresh) {
  for (const [at, child] of [...fresh.childNodes].entries()) {
    const there = old.childNodes[at];
    if (!there) old.append(child.cloneNode(true));
    else if (alike(there, child)) renew(there, child);
    else there.replaceWith(child.cloneNode(true));
  }
  while (old.childNodes.length > fresh.childNodes.length) old.lastChild.remove();
}

function alike(one, other) {
  return one.nodeName === other.nodeName && (one.dataset?.key ?? "") === (other.dataset?.key ?? "");
}

function renew(old, fresh) {
  if (old.nodeType !== Node.ELEMENT_NODE) {
    if (old.data !== fresh.data) old.data = fresh.data;
    return;
  }
  for (const { name, value } of fresh.attributes) if (old.getAttribute(name) !== value) old.setAttribute(name, value);
  for (const { name } of [...old.attributes]) {
    // What a person opened stays open.
    if (!fresh.hasAttribute(name) && name !== "open") old.removeAttribute(name);
  }
  lay(old, fresh);
}

/** White space between rows is nothing to lay over. */
function bare(place) {
  for (const body of place.querySelectorAll("tbody")) {
    for (const node of [...body.childNodes]) if (node.nodeType === Node.TEXT_NODE) node.remove();
  }
}

/** Rows of people stay the same rows when others come before them or go. */
function rows(old, fresh) {
  bare(old);
  bare(fresh);
  const known = new Map([...old.querySelectorAll("tr[data-key]")].map((row) => [row.dataset.key, row]));
  let before = null;
  for (const row of [...fresh.querySelectorAll("tr[data-key]")].reverse()) {
    const there = known.get(row.dataset.key);
    if (there) {
      known.delete(row.dataset.key);
      before = there;
      continue;
    }
    const body = old.querySelector("tbody");
    if (!body) return;
    const made = row.cloneNode(true);
    body.insertBefore(made, before);
    before = made;
  }
  for (const gone of known.values()) gone.remove();
}

function show(told) {
  for (const [name, html] of Object.entries(told)) {
    const place = document.querySelector(`[data-part="${name}"]`);
    if (!place) continue;
    const fresh = document.createElement("template");
    fresh.innerHTML = html;
    rows(place, fresh.content);
    lay(place, fresh.content);
  }
  if (told.clock) {
    moment.dateTime = told.clock.iso;
    moment.textContent = told.clock.text;
    ahead = Date.now() - Date.parse(told.clock.iso);
    if (told.clock.arrived) document.querySelector("#parts").hidden = false;
    if (told.clock.arrived) document.querySelector(".empty")?.remove();
  }
  tell();
}

/** Seconds as a person says them; the server writes the same in routes/admin/words.py. */
function elapsed(seconds) {
  for (const [unit, name] of [[86400, "d"], [3600, "h"], [60, "min"]]) {
    if (seconds >= unit) return `${Math.floor(seconds / unit)} ${name}`;
  }
  return `${Math.floor(seconds)} s`;
}

function tell() {
  const passed = Math.max(Date.now() - ahead - Date.parse(moment.dateTime), 0) / 1000;
  const whole = Math.floor(passed);
  age.textContent = whole < 60 ? `${whole} ${whole === 1 ? "second" : "seconds"} ago, ` : `${elapsed(passed)} ago, `;
  if (!source) return;
  for (const time of document.querySelectorAll("time[data-since]")) {
    const since = (Date.now() - ahead - Date.parse(time.dateTime)) / 1000;
    const words = elapsed(Math.max(since, 0));
    if (time.textContent !== words) time.textContent = words;
  }
}

function mark(words, good) {
  live.hidden = false;
  live.classList.toggle("good", good);
  live.lastElementChild.textContent = words;
}

function open() {
  if (source || paused || ended || document.hidden) return;
  clearTimeout(again);
  source = new EventSource(watch.dataset.stream);
  source.addEventListener("look", (event) => {
    show(JSON.parse(event.data));
    mark("Live", true);
  });
  source.addEventListener("end", (event) => {
    ended = true;
    mark(JSON.parse(event.data).why, false);
    pause.hidden = true;
    close();
  });
  source.addEventListener("error", () => {
    if (ended) return;
    mark("Reconnecting", false);
    // The browser tries again by itself unless it was refused.
    if (source?.readyState !== EventSource.CLOSED) return;
    close();
    again = setTimeout(open, AGAIN);
  });
}

function close() {
  source?.close();
  source = null;
}

pause.addEventListener("click", () => {
  paused = !paused;
  pause.textContent = paused ? "Resume updates" : "Pause updates";
  if (!paused) return open();
  close();
  mark("Paused", false);
});
document.addEventListener("visibilitychange", () => (document.hidden ? close() : open()));
addEventListener("pagehide", close);

pause.hidden = false;
age.hidden = false;
document.querySelector("#reload").hidden = true;
tell();
setInterval(tell, 1000);
open();
