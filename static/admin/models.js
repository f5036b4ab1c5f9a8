// While a head is being imported, look now and then how it stands; when it is there, show the page anew.

const AGAIN = 3000;

const running = () => document.querySelector("#import[data-running]");

async function look() {
  const reply = await fetch(location.pathname).catch(() => null);
  // Whoever was signed out meanwhile, or cannot reach the server, finds out by reloading.
  if (!reply?.ok) return void setTimeout(look, AGAIN);
  const fresh = new DOMParser().parseFromString(await reply.text(), "text/html");
  if (fresh.querySelector("#import[data-running]")) setTimeout(look, AGAIN);
  else location.reload();
}

if (running()) setTimeout(look, AGAIN);
