// How long to wait before the next try: 1, 2, 4, 8, then every 15 seconds.

const PAUSES = [1, 2, 4, 8, 15];

export const secondsAfter = (failures) => PAUSES[Math.min(failures, PAUSES.length - 1)];
