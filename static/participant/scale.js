// Keys on the rating page: 1 to 7 answer the scale in focus, Enter goes on.

export function scaleKeys(form) {
  form.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    const scale = event.target.closest("fieldset");
    const value = scale && /^[1-7]$/.test(event.key) && scale.querySelector(`input[value="${event.key}"]`);
    if (!value) return;
    event.preventDefault();
    value.checked = true;
    value.focus();
  });
}
