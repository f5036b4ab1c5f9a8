// Consent, instructions and rating: a plain form that also keeps its answer on the device until it has arrived.

import { address, byId, say } from "./page.js";
import { dialogs } from "./dialog.js";
import { Outbox } from "./outbox.js";
import { wrongFields } from "./formcheck.js";
import { scaleKeys } from "./scale.js";

const form = document.querySelector("form[data-answer]");
const outbox = new Outbox(address);
const forward = () => location.replace(address);

const BUILD = {
  consent: (data) => ({ given: data.get("given") !== "false" }),
  instructions: () => ({}),
  rating: (data) => ({
    trial: data.get("trial"),
    values: Object.fromEntries(
      [...form.querySelectorAll("fieldset")].map((scale) => scale.querySelector("input").name).map((name) => [name, Number(data.get(name))]),
    ),
  }),
};

form.addEventListener("submit", async (event) => {
  event.preventDefault();
  if (form.dataset.sending) return;
  const data = new FormData(form, event.submitter);
  if (data.get("given") !== "false" && wrongFields(form)) return;
  form.dataset.sending = "true";
  const notice = waitNotice();
  outbox.onwaiting = (seconds) => notice(seconds);
  const kind = form.dataset.answer;
  await outbox.deliver({ id: data.get("id"), kind, ...BUILD[kind](data) }).catch(() => null);
  await outbox.tidy;
  forward();
});

/** Below the buttons: that the answer is safe, and when the next try is. */
function waitNotice() {
  const box = document.createElement("div");
  box.className = "waiting";
  box.setAttribute("role", "status");
  const countdown = document.createElement("p");
  const retry = Object.assign(document.createElement("button"), { type: "button", className: "button", textContent: say("try_now") });
  retry.addEventListener("click", () => outbox.tryNow());
  return (seconds) => {
    if (!box.isConnected) {
      box.append(line(`${say("offline")}. ${say("offline_text")}`), countdown, retry);
      form.append(box);
    }
    countdown.textContent = seconds ? say("next_try", { count: seconds }) : say("trying");
  };
}

function line(text) {
  return Object.assign(document.createElement("p"), { textContent: text });
}

dialogs();
if (form.dataset.answer === "rating") scaleKeys(form);
addEventListener("pageshow", (event) => event.persisted && location.reload());
outbox.deliverLeft().then((count) => count && forward());
byId("summary")?.hidden === false && byId("summary").focus();
