// The playhead: moves through the recorded times of a trial and shows in its row what was chosen so far.

import { Selection } from "../participant/selection.js";

const SAME = 0.02;
const END = 0.01;

const player = document.querySelector(".player");
const rows = [...document.querySelectorAll("tr[data-seconds]")].map(read);
const total = rows.reduce((sum, row) => sum + row.seconds, 0);
if (player && total > 0) begin();

function read(element, index, all) {
  const before = all.slice(0, index).reduce((sum, one) => sum + Number(one.dataset.seconds), 0);
  const cells = [...element.querySelectorAll("td[data-place]")];
  return {
    element,
    cells,
    start: before,
    seconds: Number(element.dataset.seconds),
    moments: JSON.parse(element.dataset.moments),
    recorded: cells.map((cell) => cell.className),
    label: element.querySelector("th").textContent.trim(),
  };
}

function begin() {
  const range = player.querySelector("input[type=range]");
  const play = player.querySelector(".play");
  const at = player.querySelector(".at");
  let now = 0;
  let last = 0;
  let timer = 0;
  let shown = null;

  const speed = () => Number(player.querySelector("[name=speed]:checked").value);
  const rowAt = (time) => rows.findLast((row) => row.start <= time && row.seconds > 0) ?? rows[0];

  function show(time) {
    now = Math.min(Math.max(time, 0), total);
    range.value = String(now);
    range.setAttribute("aria-valuetext", `${clock(now)} of ${clock(total)}`);
    at.textContent = `${clock(now)} of ${clock(total)}`;
    const row = rowAt(now);
    if (row !== shown) {
      leave();
      enter(row);
    }
    marks(row, now - row.start);
  }

  function leave() {
    if (!shown) return;
    shown.element.classList.remove("now");
    shown.element.removeAttribute("aria-current");
    shown.element.querySelector("small.shown")?.remove();
    shown.cells.forEach((cell, place) => dress(cell, shown.recorded[place]));
  }

  function enter(row) {
    shown = row;
    row.element.classList.add("now");
    row.element.setAttribute("aria-current", "step");
    const note = document.createElement("small");
    note.className = "shown";
    note.textContent = "shown now";
    row.element.querySelector("th").append(note);
    document.querySelector("#said").textContent = `Generation ${row.label}`;
    const box = row.element.getBoundingClientRect();
    if (timer && (box.bottom > innerHeight || box.top < 0)) row.element.scrollIntoView({ block: "center" });
  }

  function run(time) {
    const passed = ((time - last) / 1000) * speed();
    last = time;
    show(now + passed);
    if (now >= total) return halt();
    timer = requestAnimationFrame(run);
  }

  function halt() {
    cancelAnimationFrame(timer);
    timer = 0;
    play.classList.remove("playing");
    play.querySelector(".hidden").textContent = "Play";
  }

  function go() {
    if (now >= total) show(0);
    play.classList.add("playing");
    play.querySelector(".hidden").textContent = "Pause";
    last = performance.now();
    timer = requestAnimationFrame(run);
  }

  play.addEventListener("click", () => (timer ? halt() : go()));
  range.addEventListener("input", () => show(Number(range.value)));
  for (const button of player.querySelectorAll(".step")) {
    button.addEventListener("click", () => {
      const next = rows.indexOf(shown ?? rows[0]) + Number(button.dataset.by);
      const row = rows[Math.min(Math.max(next, 0), rows.length - 1)];
      show(row.start + Math.max(row.seconds - END, 0));
    });
  }
  for (const row of rows) tick(row.start);
  tick(total);
  at.textContent = `0:00 of ${clock(total)}`;
  player.hidden = false;
}

/** Show in a row what was chosen after some seconds; at its end, what was recorded. */
function marks(row, seconds) {
  if (!row.moments.length || seconds >= row.seconds) {
    row.cells.forEach((cell, place) => dress(cell, row.recorded[place]));
    return;
  }
  const { chosen, best, enlarged } = played(row.moments, seconds);
  for (const cell of row.cells) {
    const place = Number(cell.dataset.place);
    dress(cell, best === place ? "best" : chosen.includes(place) ? "chosen" : "");
    cell.classList.toggle("enlarged", enlarged === place);
  }
}

/** Let the participant's own rules replay what happened up to a moment. */
function played(moments, seconds) {
  const selection = new Selection({ minimum: 1, maximum: 10 });
  let enlarged = null;
  moments.forEach(([time, type, place], index) => {
    if (time > seconds) return;
    const next = moments[index + 1];
    // Marking a face that was not chosen is one act, recorded as two.
    const together = type === "select" && next?.[1] === "best" && next[2] === place && next[0] - time < SAME;
    if (type === "enlarge") enlarged = place;
    else if (type === "enlarge_end") enlarged = null;
    else if (type === "undo") selection.undo();
    else if (type === "best") selection.mark(place);
    else if (!together && selection.has(place) === (type === "deselect")) selection.toggle(place);
  });
  return { chosen: selection.chosen, best: selection.best, enlarged };
}

function dress(cell, name) {
  if (cell.className !== name) cell.className = name;
  const state = cell.querySelector(".state");
  const words = { best: ", best match", chosen: ", chosen" }[name] ?? "";
  if (state.textContent !== words) state.textContent = words;
}

function tick(seconds) {
  const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
  line.setAttribute("d", `M${(1000 * seconds) / total} 3V17`);
  player.querySelector(".track svg").append(line);
}

function clock(seconds) {
  const whole = Math.round(seconds);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}
