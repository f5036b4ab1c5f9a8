// Sliders of a head: a number beside each, and the way back where one was moved. For every page that has some.

/** What a slider or colour stands at, short enough to read. */
export function rounded(value) {
  return Math.round(value * 100) / 100;
}

/** Whether what is typed beside a slider is a number that the slider can stand at. */
export function fits(typed) {
  return typed.value !== "" && typed.validity.valid;
}

export function field(input) {
  return input.parentElement.querySelector(".typed");
}

/** Fill the track from the middle, or from the start where a slider has none, to where it stands. */
function fill(input) {
  const [low, high] = [Number(input.min), Number(input.max)];
  const place = (value) => (value - low) / (high - low);
  const ends = [place(Math.max(low, 0)), place(Number(input.value))].sort((one, other) => one - other);
  input.style.setProperty("--middle", low < 0 ? place(0) : -1);
  input.style.setProperty("--from", low < 0 ? ends[0] : -1);
  input.style.setProperty("--to", low < 0 ? ends[1] : place(Number(input.value)));
}

/** Show a control's number, and the way back where it was changed. */
export function tell(input) {
  if (input.type === "range") fill(input);
  const typed = field(input);
  if (typed && typed !== document.activeElement) {
    typed.value = rounded(input.value);
    typed.removeAttribute("aria-invalid");
  }
  input.parentElement.querySelector(".reset").hidden = input.value === input.dataset.start;
}

/** Show the numbers of all sliders in a part of the page. */
export function begin(root) {
  for (const input of root.querySelectorAll(".control > [name]")) {
    // Browsers rewrite a value to one that the slider can stand at.
    input.dataset.start = input.value === input.defaultValue ? input.dataset.start : input.value;
    const typed = field(input);
    if (typed) {
      typed.hidden = false;
      typed.disabled = false;
    }
    tell(input);
  }
}

/** Follow what is dragged or typed; whether it is something that the head can be drawn with. */
export function follow(input) {
  const control = input.closest(".control");
  if (!control) return true;
  if (input.classList.contains("typed")) {
    if (!fits(input)) return false;
    input.removeAttribute("aria-invalid");
    control.querySelector("[name]").value = input.value;
  } else if (input.type === "range") {
    // A drag stops anywhere; two decimals are enough and can be read.
    input.value = rounded(input.value);
  }
  tell(control.querySelector("[name]"));
  return true;
}

/** Mark a number that does not fit, once it is left; return what is wrong with it. */
export function check(input) {
  if (!input.classList.contains("typed") || fits(input)) return "";
  input.setAttribute("aria-invalid", "true");
  return `${input.getAttribute("aria-label")}: expected ${input.min} to ${input.max}.`;
}

/** Set the slider of a pressed reset button back; return it, nothing for another click. */
export function reset(event) {
  const button = event.target.closest(".reset");
  if (!button) return null;
  const input = button.parentElement.querySelector("[name]");
  input.value = input.dataset.start;
  tell(input);
  input.focus();
  return input;
}
