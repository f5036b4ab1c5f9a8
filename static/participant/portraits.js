// Ten pictures, all fetched and decoded before any is shown.

import { secondsAfter } from "./backoff.js";
import { wait } from "./page.js";

const PATIENCE = 30000;
const TRIES = 3;

/** Draw all faces; tells the count after each. Resolves with the pictures, null in the place of one that failed. */
export function draw(faces, { fresh = false, onReady = () => {} } = {}) {
  let ready = 0;
  // The browser keeps only so many entries, and those of earlier faces are of no use: see drawnFor.
  performance.clearResourceTimings();
  return Promise.all(
    faces.map(async ({ portrait }) => {
      const image = await tried(portrait, fresh);
      if (image) onReady((ready += 1));
      return image;
    }),
  );
}

/** How long the server drew the slowest of these faces, as it says with each; null if all were there before. */
export function drawnFor(faces) {
  const said = faces.flatMap(({ portrait }) =>
    performance
      .getEntriesByName(new URL(portrait, location.href).href, "resource")
      // A picture out of the browser's cache was drawn for an earlier generation.
      .filter(({ transferSize }) => transferSize > 0)
      .flatMap(({ serverTiming = [] }) => [...serverTiming])
      .filter(({ name }) => name === "draw")
      .map(({ duration }) => duration),
  );
  return said.length ? Math.max(...said) : null;
}

async function tried(address, fresh) {
  for (let failures = 0; failures < TRIES; failures += 1) {
    const image = await decoded(address, fresh || failures > 0);
    if (image || failures === TRIES - 1) return image;
    await wait(secondsAfter(failures) * 1000);
  }
  return null;
}

async function decoded(address, fresh) {
  try {
    // A failed answer may sit in the browser's cache under the same address.
    if (fresh) await fetch(address, { cache: "reload" });
    const image = picture();
    image.src = address;
    await Promise.race([image.decode(), late()]);
    return image;
  } catch {
    return null;
  }
}

function picture() {
  const image = new Image(400, 480);
  image.alt = "";
  image.decoding = "sync";
  image.draggable = false;
  return image;
}

const late = () => new Promise((_, fail) => setTimeout(() => fail(new Error("late")), PATIENCE));
