// The device's own memory: answers, events and marks wait here until the server has them. Without IndexedDB (some
// private windows, a full disk) the page's memory serves; then only closing the page could lose what was not sent.

const memory = { answers: new Map(), events: new Map(), marks: new Map() };
const PATIENCE = 1000;
let opening = null;

function open() {
  opening ??= new Promise((done) => {
    setTimeout(() => done(null), PATIENCE);
    const request = indexedDB.open("emogen", 2);
    request.onupgradeneeded = () => {
      const known = request.result.objectStoreNames;
      for (const name of Object.keys(memory)) if (!known.contains(name)) request.result.createObjectStore(name, { keyPath: "id" });
    };
    request.onsuccess = () => {
      request.result.onversionchange = () => request.result.close();
      done(request.result);
    };
    request.onerror = request.onblocked = () => done(null);
  }).catch(() => null);
  return opening;
}

async function run(store, mode, work, fallback) {
  const database = await open();
  if (!database) return fallback(memory[store]);
  return new Promise((done) => {
    try {
      const transaction = database.transaction(store, mode, { durability: "relaxed" });
      const request = work(transaction.objectStore(store));
      transaction.oncomplete = () => done(request?.result);
      transaction.onabort = transaction.onerror = () => done(fallback(memory[store]));
    } catch {
      done(fallback(memory[store]));
    }
  });
}

/** Keep an item; resolves with whether the device has it, or only this page. */
export async function put(store, item) {
  return (await run(store, "readwrite", (box) => box.put(item), (map) => map.set(item.id, item) && null)) !== null;
}

export async function remove(store, ids) {
  for (const id of ids) memory[store].delete(id);
  await run(store, "readwrite", (box) => ids.map((id) => box.delete(id)).at(-1), () => undefined);
}

/** What waits for one participation, oldest first. */
export async function waiting(store, address) {
  const kept = (await run(store, "readonly", (box) => box.getAll(), () => [])) ?? [];
  const all = new Map([...kept, ...memory[store].values()].map((item) => [item.id, item]));
  return [...all.values()].filter((item) => item.address === address).sort((a, b) => a.at - b.at);
}
