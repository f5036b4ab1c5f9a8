// A choice as it is sent: what was chosen, when, and on what.

const at = (moment) => Math.round(moment);

/** `shown` holds the times of these faces; `hidden` is how long the window was out of sight meanwhile. */
export function choice({ id, attempt, generation }, selection, { shown, hidden, input, none, grid }) {
  const { width, height } = grid.tiles[0].root.getBoundingClientRect();
  return {
    kind: "choice",
    trial: id,
    attempt,
    generation,
    selected: selection.chosen,
    elite: selection.best,
    timing: { ...shown, chosen_ms: at(performance.now()), hidden_ms: hidden },
    client: {
      viewport: [innerWidth, innerHeight],
      pixel_ratio: devicePixelRatio,
      tile: [Math.round(width), Math.round(height)],
      input,
    },
    ...(none ? { none_is_close: none.checked } : {}),
  };
}

export const times = ({ requested, decoded, onset, drawn }) => ({
  requested_ms: at(requested),
  decoded_ms: at(decoded),
  onset_ms: at(onset),
  ...(drawn === null ? {} : { drawn_ms: drawn }),
});

/** The span from the choice to the faces, for the developer tools and `emogen bench turnaround`. */
export function measured(start, { requested, decoded, onset, drawn }) {
  performance.measure("emogen-turnaround", { start, end: onset, detail: { start, requested, decoded, onset, drawn } });
}
