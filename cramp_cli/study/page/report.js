// Charts and film of a run. One moment is shared by all of them: whoever changes it calls goTo.

const WIDE = 900, TALL = 210, LEFT = 70, RIGHT = 14, TOP = 10, BOTTOM = 36;
const listeners = [];
let now = data.end;

function goTo(time) {
  now = Math.min(Math.max(time, 0), data.end);
  for (const listen of listeners) listen(now);
}

function timeText(time) {
  return `${shown(time / data.time.size)} ${data.time.unit}`;
}

function nearest(times, time) {
  let low = 0, high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] < time) low = middle; else high = middle;
  }
  return Math.abs(times[low] - time) <= Math.abs(times[high] - time) ? low : high;
}

function chart(host, spec) {
  const figure = make(host, "figure"), caption = make(figure, "figcaption");
  const heading = make(caption, "b"), [symbol, index] = spec.title.split("_");
  make(heading, "span", {}, symbol);
  if (index) make(heading, "sub", {}, index);
  make(heading, "span", {}, spec.unit ? ` (${spec.unit})` : "");
  const hidden = new Set(), readings = [];
  spec.lines.forEach((line, index) => {
    const button = make(caption, "button", { type: "button", "aria-pressed": "true" });
    const swatch = make(button, "svg", { class: "swatch", viewBox: "0 0 30 10", "aria-hidden": "true" });
    make(swatch, "path", { d: "M0 5H30", class: classOf(line) });
    make(button, "span", {}, line.name);
    readings.push(make(button, "output", {}));
    button.addEventListener("click", () => {
      if (hidden.has(index)) hidden.delete(index); else hidden.add(index);
      button.setAttribute("aria-pressed", String(!hidden.has(index)));
      draw();
    });
  });
  const svg = make(figure, "svg", { viewBox: `0 0 ${WIDE} ${TALL}`, tabindex: "0", role: "img" });
  svg.setAttribute("aria-label", `${spec.title} over time; arrow keys move the time`);
  const x = (time) => LEFT + ((WIDE - LEFT - RIGHT) * time) / (data.end || 1);
  let cursor = null;

  function range() {
    let low = 0, high = 0;
    spec.lines.forEach((line, index) => {
      if (hidden.has(index)) return;
      for (const v of line.values) if (v !== null) { low = Math.min(low, v); high = Math.max(high, v); }
    });
    const least = spec.least || 1e-30;
    if (Math.max(high, -low) < least) return [-least, least];
    const margin = 0.06 * (high - low);
    return [low < 0 ? low - margin : 0, high > 0 ? high + margin : 0];
  }

  function draw() {
    svg.replaceChildren();
    const [low, high] = range();
    const y = (value) => TOP + ((TALL - TOP - BOTTOM) * (high - value)) / (high - low);
    for (const value of ticks(low, high, 6)) {
      make(svg, "path", { d: `M${LEFT} ${y(value)}H${WIDE - RIGHT}`, class: value ? "grid" : "zero" });
      make(svg, "text", { x: LEFT - 8, y: y(value) + 4, "text-anchor": "end" }, shown(value));
    }
    for (const value of ticks(0, data.end / data.time.size, 8)) {
      const at = x(value * data.time.size);
      make(svg, "path", { d: `M${at} ${TALL - BOTTOM}v4`, class: "zero" });
      make(svg, "text", { x: at, y: TALL - BOTTOM + 16, "text-anchor": "middle" }, shown(value));
    }
    make(svg, "text", { x: WIDE - RIGHT, y: TALL - 3, "text-anchor": "end" }, `time (${data.time.unit})`);
    spec.lines.forEach((line, index) => { if (!hidden.has(index)) curve(line, y); });
    cursor = make(svg, "path", { class: "now" });
    move(now);
  }

  function curve(line, y) {
    let path = "", pen = "M";
    line.time.forEach((time, n) => {
      const value = line.values[n];
      if (value === null) { pen = "M"; return; }
      path += `${pen}${x(time).toFixed(1)} ${y(value).toFixed(1)}`;
      pen = "L";
    });
    make(svg, "path", { d: path, class: classOf(line) });
    (line.remarks || []).forEach((remark, n) => {
      if (!remark || line.values[n] === null) return;
      const dot = { cx: x(line.time[n]), cy: y(line.values[n]), r: 3.2, class: `remark c${line.colour % 6}` };
      make(make(svg, "circle", dot), "title", {}, remark);
    });
  }

  function move(time) {
    cursor.setAttribute("d", `M${x(time)} ${TOP}V${TALL - BOTTOM}`);
    spec.lines.forEach((line, index) => {
      readings[index].textContent = shown(line.values[nearest(line.time, time)]);
    });
  }

  svg.addEventListener("pointermove", (event) => {
    const box = svg.getBoundingClientRect();
    const at = ((event.clientX - box.left) / box.width) * WIDE;
    goTo(((at - LEFT) / (WIDE - LEFT - RIGHT)) * data.end);
  });
  svg.addEventListener("keydown", (event) => {
    const times = spec.lines[0].time, at = nearest(times, now);
    const next = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: times.length - 1 }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    goTo(times[Math.min(Math.max(next, 0), times.length - 1)]);
  });
  draw();
  listeners.push(move);
}

function classOf(line) {
  return `curve c${line.colour % 6}${line.dashed ? " dash" : ""}`;
}

// ------------------------------------------------------------ film

const PLAIN = "440154 482475 414487 355f8d 2a788e 21918c 22a884 44bf70 7ad151 bddf26 fde725";
const SIGNED = "3b4cc0 7b9ff9 c0d4f5 dddddd f2cbb7 ee8468 b40426";

function palette(text) {
  const anchors = text.split(" ").map((hex) => [0, 2, 4].map((n) => parseInt(hex.slice(n, n + 2), 16)));
  return Array.from({ length: 256 }, (_, level) => {
    const place = (level / 255) * (anchors.length - 1), at = Math.min(Math.floor(place), anchors.length - 2);
    const mixed = anchors[at].map((v, n) => Math.round(v + (place - at) * (anchors[at + 1][n] - v)));
    return `rgb(${mixed})`;
  });
}

function unpacked(text, Kind) {
  const raw = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Kind(raw.buffer);
}

function showFilm(film) {
  const canvas = byId("canvas"), slider = byId("slider");
  const select = byId("quantity"), play = byId("play");
  const clock = byId("clock");
  const times = film.frames.map((frame) => frame.time);
  const [x0, y0, x1, y1] = film.box;
  byId("film").hidden = false;
  film.quantities.forEach((one, index) => make(select, "option", { value: index }, one.name));
  slider.max = times.length - 1;
  let frame = times.length - 1, timer = null;

  function draw() {
    const one = film.quantities[Number(select.value)], colours = palette(one.signed ? SIGNED : PLAIN);
    const ratio = window.devicePixelRatio || 1, wide = canvas.clientWidth * ratio;
    const scale = Math.min((wide * 0.94) / (x1 - x0), (window.innerHeight * 0.62 * ratio) / (y1 - y0));
    const tall = (y1 - y0) * scale + 44 * ratio;
    canvas.width = wide;
    canvas.height = tall;
    canvas.style.height = `${tall / ratio}px`;
    const left = (wide - (x1 - x0) * scale) / 2, top = 8 * ratio;
    const paper = canvas.getContext("2d"), ink = getComputedStyle(document.body);
    const px = (x) => left + (x - x0) * scale, py = (y) => top + (y1 - y) * scale;
    const points = unpacked(film.frames[frame].points, Uint16Array);
    const values = unpacked(one.values[frame], Uint8Array), side = film.size * scale;
    values.forEach((level, n) => {
      const x = px(x0 + (points[2 * n] / 65535) * (x1 - x0)), y = py(y0 + (points[2 * n + 1] / 65535) * (y1 - y0));
      paper.fillStyle = colours[level];
      paper.fillRect(Math.floor(x - side / 2), Math.floor(y - side / 2), Math.ceil(side) + 1, Math.ceil(side) + 1);
    });
    cracks(paper, px, py, ratio, ink);
    scaleBar(paper, scale, wide, tall, ratio, ink);
    legend(one, colours);
    slider.value = frame;
    slider.setAttribute("aria-valuetext", timeText(times[frame]));
    clock.textContent = timeText(times[frame]);
  }

  function cracks(paper, px, py, ratio, ink) {
    for (const faces of film.cracks[frame]) {
      const lines = faces.map((face) => face.reduce((all, v, n) => (n % 2 ? all[all.length - 1].push(v) : all.push([v]), all), []));
      paper.beginPath();
      lines.flat().forEach(([x, y]) => paper.lineTo(px(x), py(y)));
      paper.closePath();
      paper.fillStyle = ink.getPropertyValue("--card");
      paper.fill();
      paper.strokeStyle = ink.getPropertyValue("--ink");
      paper.lineWidth = 1.3 * ratio;
      for (const line of lines) {
        paper.beginPath();
        line.forEach(([x, y]) => paper.lineTo(px(x), py(y)));
        paper.stroke();
      }
    }
  }

  function scaleBar(paper, scale, wide, tall, ratio, ink) {
    const { size, unit } = film.length, length = ticks(0, (x1 - x0) / size, 5)[1], bar = length * size * scale;
    paper.fillStyle = ink.getPropertyValue("--ink");
    paper.fillRect((wide - bar) / 2, tall - 8 * ratio, bar, 2 * ratio);
    paper.font = `${12 * ratio}px system-ui, sans-serif`;
    paper.textAlign = "center";
    paper.fillText(`${shown(length)} ${unit}`, wide / 2, tall - 12 * ratio);
  }

  function legend(one, colours) {
    const strip = byId("colours"), paper = strip.getContext("2d");
    strip.width = 256;
    colours.forEach((colour, level) => { paper.fillStyle = colour; paper.fillRect(level, 0, 1, 12); });
    byId("low").textContent = shown(one.low);
    byId("high").textContent = `${shown(one.high)} and more`;
  }

  function stop() {
    clearInterval(timer);
    timer = null;
    play.textContent = "play";
    play.setAttribute("aria-pressed", "false");
  }

  play.addEventListener("click", () => {
    if (timer) { stop(); return; }
    play.textContent = "stop";
    play.setAttribute("aria-pressed", "true");
    if (frame === times.length - 1) goTo(times[0]);
    timer = setInterval(() => {
      if (frame < times.length - 1) goTo(times[frame + 1]); else stop();
    }, 120);
  });
  slider.addEventListener("input", () => goTo(times[Number(slider.value)]));
  select.addEventListener("change", draw);
  window.addEventListener("resize", draw);
  listeners.push((time) => {
    const next = nearest(times, time);
    if (next !== frame) { frame = next; draw(); }
  });
  redraw = draw;
  draw();
}

let redraw = () => {};

theme(redraw);
for (const spec of data.charts) chart(byId("charts"), spec);
if (data.film) showFilm(data.film);
