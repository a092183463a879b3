"use strict";
// The arm in space: as it bends, as desired, wall, force and the tip's path. Base frame, m, z upwards.
(() => {
  const given = reed.data.arm;
  if (!given) return;
  const box = document.getElementById("reed-arm"), canvas = box.querySelector("canvas"), paint = canvas.getContext("2d");
  const part = name => box.querySelector("." + name);
  const t = reed.floats(given.t), rigid = reed.floats(given.rigid), bend = reed.floats(given.bend);
  const desired = reed.floats(given.desired), force = reed.floats(given.force);
  const points = given.rigid.shape[1], nodes = given.desired.shape[1], tip = points - 1;
  const ARM_m = 0.018, GHOST_m = 0.03, TRACE_m = 0.0025, AXIS_m = 0.1, CELL_m = 0.1, LARGEST = 50;
  const colour = name => reed.rgb(given.rgb[name]);
  box.hidden = false;

  const at = (numbers, count, frame, k) => { const i = 3 * (frame * count + k); return [numbers[i], numbers[i + 1], numbers[i + 2]]; };
  const add = (a, b, s) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
  const drawn = (frame, k) => add(at(rigid, points, frame, k), at(bend, points, frame, k), scale);
  const frameAt = time => { let low = 0, high = t.length - 1; while (low < high) { const mid = (low + high + 1) >> 1; if (t[mid] <= time + 1e-6) low = mid; else high = mid - 1; } return low; };

  // The view: about the middle of everything that the arm reaches.
  const low = [0, 0, 0], high = [0, 0, 0];
  for (const numbers of [rigid, desired]) for (let i = 0; i < numbers.length; ++i) { low[i % 3] = Math.min(low[i % 3], numbers[i]); high[i % 3] = Math.max(high[i % 3], numbers[i]); }
  const middle = low.map((value, k) => (value + high[k]) / 2), size = Math.max(0.2, Math.hypot(...low.map((value, k) => high[k] - value)));
  const home = {turn: -0.9, rise: 0.28, zoom: 1};
  let view = {...home}, scale = 1, playing = false, before = 0;

  function projection() {
    const {turn, rise, zoom} = view, c = Math.cos(turn), s = Math.sin(turn), cr = Math.cos(rise), sr = Math.sin(rise);
    const far = 2.6 * size, pixels = 0.72 * zoom * Math.min(canvas.width, 1.6 * canvas.height) / size;
    return p => {
      const x = p[0] - middle[0], y = p[1] - middle[1], z = p[2] - middle[2];
      const depth = cr * c * x + cr * s * y + sr * z, near = far / Math.max(0.1 * far, far - depth);
      return [canvas.width / 2 + pixels * near * (c * y - s * x), canvas.height / 2 - pixels * near * (cr * z - sr * c * x - sr * s * y), pixels * near];
    };
  }

  function line(shown, style, width) {
    paint.beginPath();
    shown.forEach((p, k) => k ? paint.lineTo(p[0], p[1]) : paint.moveTo(p[0], p[1]));
    paint.strokeStyle = style; paint.lineWidth = width; paint.stroke();
  }
  function dot(p, radius, style) { paint.beginPath(); paint.arc(p[0], p[1], radius, 0, 7); paint.fillStyle = style; paint.fill(); }
  function word(text, p, style) { paint.fillStyle = style; paint.fillText(text, p[0] + 5 * ratio(), p[1] - 4 * ratio()); }
  const ratio = () => window.devicePixelRatio || 1;

  function floor(show) {
    const reach = k => [Math.floor(low[k] / CELL_m - 2) * CELL_m, Math.ceil(high[k] / CELL_m + 2) * CELL_m];
    const [x0, x1] = reach(0), [y0, y1] = reach(1);
    for (let x = x0; x < x1 + 1e-9; x += CELL_m) line([show([x, y0, 0]), show([x, y1, 0])], "#e6e6e2", ratio());
    for (let y = y0; y < y1 + 1e-9; y += CELL_m) line([show([x0, y, 0]), show([x1, y, 0])], "#e6e6e2", ratio());
    [["x", "#b33"], ["y", "#383"], ["z", "#33b"]].forEach(([name, style], k) => {
      const end = [0, 0, 0]; end[k] = AXIS_m;
      line([show([0, 0, 0]), show(end)], style, 2 * ratio()); word(name, show(end), style);
    });
  }

  function plate(show) {
    if (!given.wall) return;
    paint.beginPath();
    given.wall.map(show).forEach((p, k) => k ? paint.lineTo(p[0], p[1]) : paint.moveTo(p[0], p[1]));
    paint.closePath(); paint.fillStyle = reed.rgb(given.rgb.wall, 0.35); paint.fill();
    paint.strokeStyle = reed.rgb(given.rgb.wall); paint.lineWidth = 1.5 * ratio(); paint.stroke();
  }

  function arm(show, frame) {
    const shown = Array.from({length: points}, (_, k) => show(drawn(frame, k))), width = ARM_m * shown[0][2];
    line(shown, "rgba(90,40,0,.9)", width + 2 * ratio()); line(shown, colour("arm"), width);
    for (let k = 1; k < points; ++k) {  // two points at one place: a joint
      const a = at(rigid, points, frame, k - 1), b = at(rigid, points, frame, k);
      if (Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < 1e-6) dot(shown[k], 0.55 * width, "#333");
    }
    dot(shown[tip], 0.35 * width, "#fff");
  }

  function arrow(show, frame) {
    const pressing = at(force, 1, frame, 0), size_N = Math.hypot(...pressing);
    if (size_N < given.least_force_N) return;
    const start = drawn(frame, tip), end = add(start, pressing, given.force_mPN), a = show(start), b = show(end);
    const angle = Math.atan2(b[1] - a[1], b[0] - a[0]), head = Math.min(0.016 * a[2], Math.hypot(b[0] - a[0], b[1] - a[1]));
    line([a, b], "#fff", 0.014 * a[2]); line([a, b], colour("force"), 0.008 * a[2]);
    paint.beginPath(); paint.moveTo(b[0] + head * Math.cos(angle), b[1] + head * Math.sin(angle));
    for (const side of [2.5, -2.5]) paint.lineTo(b[0] + head * Math.cos(angle + side), b[1] + head * Math.sin(angle + side));
    paint.closePath(); paint.fillStyle = colour("force"); paint.fill();
    word(size_N.toFixed(2) + " N", [b[0] + head, b[1]], colour("force"));
  }

  function draw() {
    const frame = frameAt(reed.clock.t), show = projection();
    paint.clearRect(0, 0, canvas.width, canvas.height);
    paint.lineCap = paint.lineJoin = "round"; paint.font = `${13 * ratio()}px system-ui,sans-serif`;
    floor(show); plate(show);
    line(Array.from({length: nodes}, (_, k) => show(at(desired, nodes, frame, k))), reed.rgb(given.rgb.desired, 0.5), GHOST_m * show(middle)[2]);
    if (frame) line(Array.from({length: frame + 1}, (_, n) => show(drawn(n, tip))), colour("trace"), Math.max(1.5 * ratio(), TRACE_m * show(middle)[2]));
    arm(show, frame); arrow(show, frame);
    const off_mm = 1e3 * Math.hypot(...at(bend, points, frame, tip));
    part("clock").textContent = `${reed.clock.t.toFixed(3)} s`; part("time").value = reed.clock.t;
    part("factor").textContent = scale === 1 ? "× 1 (true)" : `× ${scale}`;
    paint.fillStyle = "#555"; paint.fillText(`t = ${t[frame].toFixed(3)} s, tip bent by ${off_mm.toFixed(2)} mm`, 10 * ratio(), 20 * ratio());
  }

  function fit() { canvas.width = canvas.clientWidth * ratio(); canvas.height = canvas.clientHeight * ratio(); draw(); }
  function play(wanted) { playing = wanted; part("play").textContent = playing ? "❚❚ pause" : "▶ play"; before = 0; if (playing) requestAnimationFrame(step); }
  function step(now) {
    if (!playing) return;
    const passed_s = before ? (now - before) / 1e3 * part("speed").value : 0;
    before = now;
    if (reed.clock.t >= reed.clock.last) return play(false);
    reed.clock.set(reed.clock.t + passed_s);
    requestAnimationFrame(step);
  }
  function toggle() { if (!playing && reed.clock.t >= reed.clock.last) reed.clock.set(reed.clock.first); play(!playing); }

  Object.assign(part("time"), {min: t[0], max: t[t.length - 1], step: 0.001});
  part("play").addEventListener("click", toggle);
  part("time").addEventListener("input", () => { play(false); reed.clock.set(Number(part("time").value)); });
  part("scale").addEventListener("input", () => { scale = Math.round(LARGEST ** (part("scale").value / 100)); draw(); });
  part("home").addEventListener("click", () => { view = {...home}; draw(); });
  canvas.addEventListener("pointermove", move => {
    if (!move.buttons) return;
    view.turn -= 0.008 * move.movementX; view.rise = Math.min(1.5, Math.max(-0.4, view.rise + 0.008 * move.movementY)); draw();
  });
  canvas.addEventListener("pointerdown", press => canvas.setPointerCapture(press.pointerId));
  canvas.addEventListener("wheel", wheel => { wheel.preventDefault(); view.zoom = Math.min(8, Math.max(0.3, view.zoom * Math.exp(-0.001 * wheel.deltaY))); draw(); }, {passive: false});
  canvas.addEventListener("keydown", key => {
    if (key.key === " ") { key.preventDefault(); toggle(); }
    const by = {ArrowRight: 1, ArrowLeft: -1}[key.key];
    if (by) { key.preventDefault(); play(false); reed.clock.set(t[Math.min(t.length - 1, Math.max(0, frameAt(reed.clock.t) + by))]); }
  });
  window.addEventListener("resize", fit);
  const named = {arm: "the arm as it bends", desired: "desired", ...(given.wall ? {wall: "true wall"} : {}), force: "force on the tip (1 N is " + 1e3 * given.force_mPN + " mm)", trace: "path of the tip"};
  for (const [name, text] of Object.entries(named)) {
    const mark = document.createElement("b"); mark.style.background = colour(name);
    part("legend").append(mark, `${text}   `);
  }
  part("keys").textContent = "Drag to turn it, use the wheel to zoom. Space plays and pauses, the arrow keys go frame by frame.";
  reed.clock.first = t[0]; reed.clock.last = t[t.length - 1];
  reed.clock.listen(draw);
  reed.clock.t = reed.clock.last;
  fit();
})();
