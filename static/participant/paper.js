// Consent, instructions, and the questions about a finished face.

import { answerForm } from "./answerform.js";

answerForm({
  consent: (data) => ({ given: data.get("given") !== "false" }),
  instructions: () => ({}),
  rating: (data, form) => ({
    trial: data.get("trial"),
    values: Object.fromEntries(
      [...form.querySelectorAll("fieldset")].map((scale) => scale.querySelector("input").name).map((name) => [name, Number(data.get(name))]),
    ),
  }),
});
