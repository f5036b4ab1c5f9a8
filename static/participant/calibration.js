// How large a millimetre of this screen is: a bank card (85.60 x 53.98 mm, ISO/IEC 7810 ID-1) is held to an outline.
// On a phone the card stands upright, since its long side is wider than the phone.

import { byId, say } from "./page.js";
import { answerForm } from "./answerform.js";

const [LONG, SHORT] = [85.6, 53.98];
const NARROW = 640;
const TWO_COLUMNS = 767;
const LOW = 530;
const [ARM, HAND] = [57, 35];
const card = byId("card");
const [slider, number, distance] = [byId("card-slider"), byId("card-number"), byId("distance")];
const degrees = Number(document.querySelector("form[data-answer]").dataset.degrees);
const upright = innerWidth <= NARROW;
const side = upright ? SHORT : LONG;

function setUp() {
  document.querySelector(".paper").classList.toggle("upright-card", upright);
  const most = Math.floor(card.parentElement.clientWidth);
  // 96 CSS pixels an inch is a usual screen at a desk; phones have about 160.
  const start = Math.min(most, Math.round((side * (upright ? 160 : 96)) / 25.4));
  for (const field of [slider, number]) Object.assign(field, { min: 60, max: most });
  if (upright) distance.value = HAND;
  else distance.value = ARM;
  take(start);
}

/** The outline, the slider and the field say the same; the field is left alone while somebody types in it. */
function take(width, from = null) {
  card.style.inlineSize = `${width}px`;
  card.style.blockSize = `${(width * (upright ? LONG : SHORT)) / side}px`;
  if (from !== slider) slider.value = width;
  if (from !== number) number.value = width;
  fit();
}

const perMillimetre = () => card.getBoundingClientRect().width / side;
const centimetres = () => Number(distance.value);
const known = () => centimetres() >= Number(distance.min) && centimetres() <= Number(distance.max);

/** Height of a picture of the wanted angle, in CSS pixels; the server reckons the same. */
const wanted = () => 2 * centimetres() * 10 * Math.tan((degrees * Math.PI) / 360) * perMillimetre();

/** Height of a picture when ten of them fill the window: static/evolve.css and phone.css. */
function room() {
  const margins = innerWidth <= NARROW ? 32 : 64;
  if (innerWidth <= TWO_COLUMNS) return Math.min((((innerWidth - margins - 10) / 2) * 6) / 5, innerHeight - (innerHeight < 560 ? 24 : 220));
  if (innerHeight < LOW) return Math.min((((innerWidth - 112) / 5) * 6) / 5, innerHeight - 24);
  const chrome = innerHeight < 700 ? 168 : 214;
  return Math.min((((innerWidth - 112) / 5) * 6) / 5, (innerHeight - chrome - 12) / 2);
}

function fit() {
  if (!known()) return;
  const share = room() / wanted();
  const text = share >= 1 ? say("fits") : say("fits_less", { percent: Math.round(share * 100) });
  const line = byId("fit");
  if (line.textContent !== text) line.textContent = text;
}

slider.addEventListener("input", () => take(Number(slider.value), slider));
number.addEventListener("input", () => inside() && take(Number(number.value), number));
number.addEventListener("change", () => take(Math.min(Math.max(Number(number.value) || 60, 60), Number(number.max))));
distance.addEventListener("input", fit);
addEventListener("resize", fit);

function inside() {
  const value = Number(number.value);
  return value >= 60 && value <= Number(number.max);
}

setUp();
answerForm({
  calibration: (data) =>
    data.get("given") === "true"
      ? { px_per_mm: Number(perMillimetre().toFixed(4)), distance_mm: centimetres() * 10 }
      : {},
});
