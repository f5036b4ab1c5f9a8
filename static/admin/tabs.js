// On a narrow window the row of tabs scrolls: the tab of this page is brought into view, without moving the page itself.

for (const here of document.querySelectorAll(".tabs [aria-current], .bar nav [aria-current]")) {
  const row = here.parentElement;
  row.scrollLeft += here.getBoundingClientRect().left - row.getBoundingClientRect().left - (row.clientWidth - here.offsetWidth) / 2;
}
