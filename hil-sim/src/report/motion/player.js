// Shows the recorded motion. Where everything is was computed when the page was written; here only the moment is chosen and drawn.
"use strict";
(() => {
  const byId = (id) => document.getElementById(id);
  const data = JSON.parse(byId("motion").textContent);
  const { step_s: step, width } = data;

  // Millimetres: x and z of every point, moment after moment. Written as differences, which are short.
  const points = Int32Array.from(data.points);
  for (let i = width; i < points.length; i++) points[i] += points[i - width];
  const moments = points.length / width;
  const x = (moment, point) => points[moment * width + 2 * point];
  const z = (moment, point) => points[moment * width + 2 * point + 1];
  const place = (moment, point) => `${x(moment, point)} ${z(moment, point)}`;

  // What moves says in its own attributes which points it hangs on.
  const marked = (mark) =>
    [...document.querySelectorAll(`[data-${mark}]`)].map((element) => ({
      element,
      points: element.dataset[mark].split(" ").map(Number),
    }));
  const [lines, areas, dots, balls] = ["through", "around", "at", "ball"].map(marked);

  const way = Array.from({ length: moments }, (_, moment) => place(moment, data.tip));
  byId("ahead").setAttribute("d", "M" + way.join("L"));

  // The ground's left end is the last of its list, so that cuts find their samples by number.
  const heights = data.ground.map(([, height]) => height);
  let cutsDone = -1;
  function drawGround(moment) {
    let cuts = 0;
    while (cuts < data.cuts.length && data.cuts[cuts][0] <= moment) cuts++;
    if (cuts === cutsDone) return;
    // Back in time nothing can be uncut: begin again.
    if (cuts < cutsDone || cutsDone < 0) data.ground.forEach(([, height], i) => (heights[i] = height));
    for (const [, sample, height] of data.cuts.slice(cuts < cutsDone ? 0 : Math.max(cutsDone, 0), cuts)) heights[sample] = height;
    cutsDone = cuts;
    const surface = data.ground.map(([reach], i) => `${reach} ${heights[i]}`);
    const left = surface.pop();
    byId("soil").setAttribute("d", `M${left}L${surface.join("L")}V-99999H${left.split(" ")[0]}Z`);
  }

  const number = (value, decimals) => value.toFixed(decimals).replace("-", "−");
  const show = (id, text) => {
    const element = byId("now-" + id);
    if (element) element.textContent = text;
  };
  function drawNumbers(moment) {
    show("time", `${number(moment * step, 2)} s`);
    show("state", data.states.findLast(([from]) => from <= moment)[1].replaceAll("_", " "));
    show("tip", `${number(x(moment, data.tip) / 1000, 2)} m, ${number(z(moment, data.tip) / 1000, 2)} m`);
    const [swing, error] = [data.swing[moment], data.error[moment]];
    show("swing", swing === null ? "–" : `${number(swing / 100, 1)}°`);
    show("error", error === null ? "–" : `${number(error / 10, 1)} mm`);
    show("load", data.load.length ? `${data.load[moment]} kg` : "–");
  }

  // A line through every figure over time.
  const cursors = [...document.querySelectorAll("line.cursor")].map((line) => {
    const [from, until, left, right] = ["from", "until", "left", "right"].map((name) => Number(line.dataset[name]));
    line.removeAttribute("visibility");
    return { line, x: (time) => left + ((time - from) / (until - from)) * (right - left), time: (at) => from + ((at - left) / (right - left)) * (until - from) };
  });

  const slider = byId("moment");
  let now = -1;
  function draw(moment) {
    now = moment;
    for (const { element, points } of lines) element.setAttribute("d", "M" + points.map((p) => place(moment, p)).join("L"));
    for (const { element, points } of areas) element.setAttribute("d", "M" + points.map((p) => place(moment, p)).join("L") + "Z");
    for (const { element, points } of dots) {
      element.setAttribute("cx", x(moment, points[0]));
      element.setAttribute("cy", z(moment, points[0]));
    }
    for (const { element, points: [middle, rim] } of balls) {
      element.setAttribute("cx", x(moment, middle));
      element.setAttribute("cy", z(moment, middle));
      element.setAttribute("r", x(moment, rim) - x(moment, middle));
    }
    byId("done").setAttribute("d", "M" + way.slice(0, moment + 1).join("L"));
    const wanted = byId("wanted");
    if (wanted) {
      const [reach, height] = data.wanted[moment] ?? [0, 0];
      wanted.setAttribute("visibility", data.wanted[moment] ? "visible" : "hidden");
      wanted.setAttribute("cx", reach);
      wanted.setAttribute("cy", height);
    }
    drawGround(moment);
    drawNumbers(moment);
    for (const cursor of cursors) {
      const at = cursor.x(moment * step);
      cursor.line.setAttribute("x1", at);
      cursor.line.setAttribute("x2", at);
    }
    slider.value = moment;
    slider.setAttribute("aria-valuetext", `${(moment * step).toFixed(2)} seconds`);
  }
  const seek = (time) => draw(Math.min(Math.max(Math.round(time / step), 0), moments - 1));

  const button = byId("play");
  let playing = false;
  let time = 0;
  let before = null;
  function tick(clock) {
    if (!playing) return;
    // The first call only sets the clock.
    if (before !== null) time += ((clock - before) / 1000) * Number(byId("speed").value);
    before = clock;
    seek(time);
    if (time >= (moments - 1) * step) play(false);
    else requestAnimationFrame(tick);
  }
  function play(on) {
    playing = on;
    button.textContent = on ? "Pause" : "Play";
    if (!on) return;
    time = now >= moments - 1 ? 0 : now * step;
    before = null;
    requestAnimationFrame(tick);
  }
  button.addEventListener("click", () => play(!playing));
  slider.addEventListener("input", () => {
    play(false);
    draw(Number(slider.value));
  });

  // A press in a figure over time leads to that time, and dragging follows.
  for (const svg of new Set(cursors.map(({ line }) => line.ownerSVGElement))) {
    const { time: timeAt } = cursors.find(({ line }) => line.ownerSVGElement === svg);
    svg.classList.add("seekable");
    const go = (event) => {
      if (event.buttons !== 1) return;
      const box = svg.getBoundingClientRect();
      play(false);
      seek(timeAt(((event.clientX - box.left) / box.width) * svg.viewBox.baseVal.width));
    };
    svg.addEventListener("pointerdown", go);
    svg.addEventListener("pointermove", go);
  }

  // `report.html#t=7.5` opens at 7.5 s: a moment to point a colleague to.
  const asked = () => Number(/^#t=([\d.]+)$/.exec(location.hash)?.[1] ?? 0);
  addEventListener("hashchange", () => seek(asked()));
  seek(asked());
})();
