// Asking the server for a portrait, and showing it: the old one stays until the new one is ready.

/** Send fields; a refusal becomes an error in the server's own words. */
export async function send(address, body, signal) {
  let reply;
  try {
    reply = await fetch(address, { method: "POST", body, signal });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new Error("The server cannot be reached. Change a slider to try again.");
  }
  const kind = reply.headers.get("Content-Type") ?? "";
  if (reply.ok && !kind.startsWith("text/html")) return reply;
  if (!kind.startsWith("application/json")) throw new Error("You are signed out, or this page is too old. Reload it.");
  const told = await reply.json();
  throw Object.assign(new Error(told.error.message), { newer: reply.status === 409, later: reply.status === 503 });
}

const shown = new WeakMap();

/** Put a picture into an image once it is decoded. */
export async function show(image, blob) {
  const address = URL.createObjectURL(blob);
  const next = new Image();
  next.src = address;
  await next.decode();
  image.src = address;
  image.hidden = false;
  if (shown.has(image)) URL.revokeObjectURL(shown.get(image));
  shown.set(image, address);
}
