// The list of sections says which one is being read.

export function letSectionsFollow(form) {
  const links = () => [...form.querySelectorAll(".sections li a")];

  function follow() {
    const cards = [...form.querySelectorAll(".cards .card")];
    const line = window.innerHeight * 0.3;
    const read = cards.filter((card) => card.getBoundingClientRect().top <= line).pop() ?? cards[0];
    for (const link of links()) {
      if (link.hash === `#${read.id}`) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    }
  }

  window.addEventListener("scroll", follow, { passive: true });
  form.addEventListener("editor:changed", follow);
  follow();
}
