// Printing needs the browser: the button is there only when this is. A report that is being made is asked for again.

const AGAIN = 2000;

const button = document.querySelector("button.print");
if (button) {
  button.hidden = false;
  button.addEventListener("click", () => print());
}

const place = document.querySelector("[data-analysis]");
const running = () => place?.querySelector("[data-running]");

/** Look how it stands with the report; where the server cannot be reached, look again later. */
async function look() {
  const reply = await fetch(place.dataset.analysis).catch(() => null);
  // Whoever was signed out meanwhile gets no piece of a page; a reload says so.
  if (reply && !reply.ok) return;
  if (reply) show(await reply.text());
  if (running()) setTimeout(look, AGAIN);
}

function show(text) {
  // Only what is said changes; the region that is read out stays the same one.
  const fresh = new DOMParser().parseFromString(text, "text/html");
  const said = fresh.querySelector(".standing");
  if (said.innerHTML === place.querySelector(".standing").innerHTML) return;
  place.querySelector(".standing").innerHTML = said.innerHTML;
  place.querySelector(".standing").toggleAttribute("data-running", said.hasAttribute("data-running"));
  const form = fresh.querySelector("form");
  if (form && !place.querySelector("form")) place.append(form);
}

if (running()) setTimeout(look, AGAIN);
