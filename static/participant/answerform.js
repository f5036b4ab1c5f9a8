// A plain form that also keeps its answer on the device until it has arrived: consent, instructions, questions.

import { address, byId } from "./page.js";
import { dialogs } from "./dialog.js";
import { drafted, forgetDraft } from "./draft.js";
import { Events } from "./events.js";
import { wrongFields } from "./formcheck.js";
import { inputKind } from "./input.js";
import { notice } from "./notice.js";
import { onward } from "./onward.js";
import { Outbox } from "./outbox.js";
import { scaleKeys } from "./scale.js";
import { stopping } from "./stopping.js";

const form = document.querySelector("form[data-answer]");
const outbox = new Outbox(address);

/** Send the form as the answer that `build`, by kind, makes of it. */
export function answerForm(build) {
  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    if (form.dataset.sending) return;
    const data = new FormData(form, event.submitter);
    if (data.get("given") !== "false" && wrongFields(form)) return;
    form.dataset.sending = "true";
    outbox.onwaiting = notice(form, outbox);
    const kind = form.dataset.answer;
    const body = { id: data.get("id"), kind, ...(await build[kind](data, form)) };
    // What is refused has to be filled in again, so it is kept.
    await outbox.deliver(body).then(forgetDraft, () => null);
    await outbox.tidy;
    onward();
  });
  dialogs();
  stopping(outbox, (erase) => {
    forgetDraft();
    outbox.onwaiting = notice(form, outbox, erase ? "stop_noted_erase" : "stop_noted_keep");
  });
  drafted(form);
  scaleKeys(form);
  sendLeft();
  begin(inputKind());
}

/** What an earlier page left behind: answers, which lead on, and events. */
function sendLeft() {
  outbox.deliverLeft().then((count) => count && onward());
  new Events(address).collectLeft();
}

/** Keys answer at once: whoever came by keyboard is at the first question, or at what is missing. */
function begin(input) {
  const summary = byId("summary");
  const question = form.querySelector("fieldset.scale");
  const first = question?.querySelector("input:checked") ?? question?.querySelector("input, textarea");
  if (summary?.hidden === false) summary.focus();
  else if (input.now === "keyboard") first?.focus();
}
