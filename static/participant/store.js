// The device's own memory: answers and events wait here until the server has them. Without IndexedDB (some private
// windows) the page's memory serves; then only closing the page could lose what was not sent.

const memory = { answers: new Map(), events: new Map() };
let opening = null;

function open() {
  opening ??= new Promise((done) => {
    const request = indexedDB.open("emogen", 1);
    request.onupgradeneeded = () => {
      for (const name of Object.keys(memory)) request.result.createObjectStore(name, { keyPath: "id" });
    };
    request.onsuccess = () => done(request.result);
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

export const put = (store, item) =>
  run(store, "readwrite", (box) => box.put(item), (map) => map.set(item.id, item));

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
