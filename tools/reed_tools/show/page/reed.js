"use strict";
// What the page's parts share: the numbers, and the time that is shown.
const reed = (() => {
  const data = JSON.parse(document.getElementById("reed-data").textContent);
  const listeners = [];
  const clock = {
    t: 0, first: 0, last: 0,
    listen(action) { listeners.push(action); },
    set(t) {
      clock.t = Math.min(Math.max(t, clock.first), clock.last);
      for (const action of listeners) action(clock.t);
    },
  };
  // {shape, base64}: 32-bit numbers, little-endian as every machine with a browser.
  function floats(entry) {
    return new Float32Array(Uint8Array.from(atob(entry.base64), letter => letter.charCodeAt(0)).buffer);
  }
  const rgb = ([r, g, b], a = 1) => `rgba(${r},${g},${b},${a})`;
  document.documentElement.classList.add("alive");
  return {data, clock, floats, rgb};
})();
