// What the server wrote into the page: address, state and words.

const read = (id) => JSON.parse(document.getElementById(id)?.textContent ?? "{}");
const { client, language, numbers } = read("words");
const plural = new Intl.PluralRules(language?.code ?? "en");

export const address = document.body.dataset.address ?? "";
export const state = read("state");
export const byId = (id) => document.getElementById(id);

export const digits = (number) => String(number).replace(/\d/g, (digit) => language.digits[digit]);

/** A key as a plain digit, where it is a digit in the script of this language. */
export function plainDigit(key) {
  const digit = key.length === 1 ? language.digits.indexOf(key) : -1;
  return digit < 0 ? key : String(digit);
}

export function say(key, values = {}) {
  const entry = client[key];
  const text = typeof entry === "string" ? entry : entry[plural.select(values.count)] ?? entry.other;
  return text.replace(/\{(\w+)\}/g, (_, name) => (typeof values[name] === "number" ? digits(values[name]) : values[name]));
}

/** New words are a new node: they appear where they belong, nothing moves there. */
export function reworded(node, text) {
  const made = Object.assign(node.cloneNode(false), { textContent: text });
  node.replaceWith(made);
  return made;
}

/** A small number as a word that can begin a sentence. */
export function word(number) {
  const text = numbers[number] ?? digits(number);
  return text.charAt(0).toLocaleUpperCase(language.code) + text.slice(1);
}

// Back from another page: what this one remembers may be long over.
addEventListener("pageshow", (event) => event.persisted && location.reload());

export const wait = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
export const frame = () => new Promise((done) => requestAnimationFrame(done));

/** Change the page within one frame; resolves with the time of the next one, the first after it was painted. */
export async function painted(change) {
  await frame();
  change();
  return frame();
}

/** Where crypto.randomUUID is missing (plain http on a private network) random bytes are still there. */
export function uuid() {
  if (crypto.randomUUID) return crypto.randomUUID();
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  bytes[6] = (bytes[6] & 0x0f) | 0x40;
  bytes[8] = (bytes[8] & 0x3f) | 0x80;
  const hex = Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
  return [hex.slice(0, 8), hex.slice(8, 12), hex.slice(12, 16), hex.slice(16, 20), hex.slice(20)].join("-");
}
