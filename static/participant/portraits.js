// Ten pictures, all fetched and decoded before any is shown.

const PATIENCE = 30000;

/** Draw all faces; tells the count after each. Resolves with the pictures, null in the place of one that failed. */
export function draw(faces, { fresh = false, onReady = () => {} } = {}) {
  let ready = 0;
  return Promise.all(
    faces.map(async ({ portrait }) => {
      const image = await decoded(portrait, fresh);
      if (image) onReady((ready += 1));
      return image;
    }),
  );
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
