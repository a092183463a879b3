"use strict";
// The curves: drag to zoom all of them, double-click to see the whole run, click to show that time; the values are under the cursor.
(() => {
  const given = reed.data.curves;
  if (!given) return;
  const box = document.getElementById("reed-curves"), t = reed.floats(given.t), plots = [];
  const HEIGHT_px = 190, DIGITS = 5;
  box.hidden = false;
  if (!reed.data.arm) { reed.clock.first = t[0]; reed.clock.last = reed.clock.t = t[t.length - 1]; }
  let zooming = false;

  function zoomAll(plot) {
    if (zooming) return;
    zooming = true;
    const {min, max} = plot.scales.x;
    for (const other of plots) if (other !== plot && (other.scales.x.min !== min || other.scales.x.max !== max)) other.setScale("x", {min, max});
    zooming = false;
    plots.forEach(place);
  }
  function place(plot) {
    const left = plot.valToPos(reed.clock.t, "x");
    plot.now.style.left = `${left}px`;
    plot.now.hidden = !(left >= 0 && left <= plot.over.clientWidth);
  }
  // In the legend: under the cursor, else of the time that the arm shows.
  function values(plot) {
    if (!(plot.cursor.left >= 0)) plot.setLegend({idx: plot.valToIdx(reed.clock.t)});
  }
  function follow() { plots.forEach(place); plots.forEach(values); }
  function marks(plot) {
    const {ctx, bbox} = plot;
    ctx.save(); ctx.setLineDash([5, 4]); ctx.textBaseline = "alphabetic"; ctx.font = `${10 * devicePixelRatio}px system-ui,sans-serif`;
    for (const [time, text, style] of given.marks) {
      if (time < plot.scales.x.min || time > plot.scales.x.max) continue;
      const x = plot.valToPos(time, "x", true);
      ctx.strokeStyle = ctx.fillStyle = style;
      ctx.beginPath(); ctx.moveTo(x, bbox.top); ctx.lineTo(x, bbox.top + bbox.height); ctx.stroke();
      ctx.save(); ctx.translate(x - 3, bbox.top + 2); ctx.rotate(-Math.PI / 2); ctx.textAlign = "right"; ctx.fillText(text, 0, 0); ctx.restore();
    }
    ctx.restore();
  }
  const seen = value => value == null ? "–" : Number(value.toPrecision(DIGITS)).toString();

  for (const panel of given.panels) {
    const holder = document.createElement("div"), title = document.createElement("h3");
    holder.className = "curve"; title.textContent = `${panel.title} [${panel.unit}]`;
    holder.append(title); box.append(holder);
    if (panel.note) holder.append(Object.assign(document.createElement("p"), {className: "hint", textContent: panel.note}));
    const numbers = reed.floats(panel.values), rows = t.length, of = k => given.colours[k % given.colours.length];
    const curves = panel.names.map((_, k) => Array.from(numbers.subarray(k * rows, (k + 1) * rows), value => Number.isFinite(value) ? value : null));
    const limits = panel.limits.map(([value]) => new Array(rows).fill(value));
    const plot = new uPlot({
      width: box.clientWidth, height: HEIGHT_px, scales: {x: {time: false}},
      cursor: {sync: {key: "reed"}, drag: {x: true, y: false}},
      series: [{label: "t [s]", value: (_, value) => value == null ? "–" : value.toFixed(4)},
               ...panel.names.map((label, k) => ({label, stroke: of(k), width: 1.3, value: (_, value) => seen(value)})),
               ...panel.limits.map(([value, k]) => ({label: seen(value), stroke: of(k), width: 1, dash: [5, 5], points: {show: false}, value: () => ""}))],
      axes: [{size: 32}, {size: 64}],
      hooks: {setScale: [(plot, key) => { if (key === "x" && plot.now) zoomAll(plot); }], setSize: [plot => plot.now && place(plot)], draw: [marks]},
    }, [Array.from(t), ...curves, ...limits], holder);
    plot.now = document.createElement("div"); plot.now.className = "now"; plot.over.append(plot.now);
    plot.over.addEventListener("click", () => { if (plot.select.width === 0) reed.clock.set(plot.posToVal(plot.cursor.left, "x")); });
    const rows_shown = holder.querySelectorAll(".u-legend .u-series");
    panel.limits.forEach((_, k) => rows_shown[1 + panel.names.length + k].remove());
    plot.over.addEventListener("mouseleave", () => setTimeout(() => values(plot)));
    plots.push(plot);
  }
  reed.clock.listen(follow);
  requestAnimationFrame(follow);  // when the diagrams stand
  window.addEventListener("resize", () => plots.forEach(plot => plot.setSize({width: box.clientWidth, height: HEIGHT_px})));
  reed.plots = plots;
})();
