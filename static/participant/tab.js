// What this tab remembers over a change of page; nothing where the browser forbids it.

const ours = (name) => `emogen ${name}`;

export function recall(name) {
  try {
    return JSON.parse(sessionStorage.getItem(ours(name)));
  } catch {
    return null;
  }
}

export function remember(name, value) {
  try {
    sessionStorage.setItem(ours(name), JSON.stringify(value));
  } catch {
    // No room, or not allowed: it is a help only.
  }
}

export function forget(name) {
  try {
    sessionStorage.removeItem(ours(name));
  } catch {
    // There was nothing.
  }
}
