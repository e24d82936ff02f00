// The response of a sweep: one number of every case over one parameter, coloured by another.

const WIDE = 900, TALL = 380, LEFT = 84, RIGHT = 20, TOP = 14, BOTTOM = 46;
// An axis: numbers stay numbers, anything else stands at 0, 1, 2 ... under its own name.
function axis(name) {
  const values = data.rows.map((row) => row[name] ?? null), given = values.filter((v) => v !== null);
  if (given.every((v) => typeof v === "number")) {
    const low = Math.min(...given), high = Math.max(...given), room = 0.06 * (high - low) || Math.abs(high) || 1;
    const from = low - room, to = high + room;
    return { at: (v) => (v - from) / (to - from), marks: ticks(from, to, 6).map((v) => [v, shown(v)]) };
  }
  const kinds = [...new Set(given.map(shown))];
  return { at: (v) => (kinds.indexOf(shown(v)) + 0.5) / kinds.length, marks: kinds.map((kind) => [kind, kind]) };
}

function draw() {
  const [xName, yName, hue] = ["x", "y", "hue"].map((name) => byId(name).value);
  const x = axis(xName), y = axis(yName), plot = byId("plot"), names = byId("names");
  plot.replaceChildren();
  names.replaceChildren();
  const svg = make(plot, "svg", { viewBox: `0 0 ${WIDE} ${TALL}`, role: "img", "aria-label": `${yName} over ${xName}` });
  const px = (v) => LEFT + (WIDE - LEFT - RIGHT) * x.at(v), py = (v) => TOP + (TALL - TOP - BOTTOM) * (1 - y.at(v));
  for (const [value, text] of y.marks) {
    make(svg, "path", { d: `M${LEFT} ${py(value)}H${WIDE - RIGHT}`, class: "grid" });
    make(svg, "text", { x: LEFT - 8, y: py(value) + 4, "text-anchor": "end" }, text);
  }
  make(svg, "path", { d: `M${LEFT} ${TALL - BOTTOM}H${WIDE - RIGHT}`, class: "zero" });
  for (const [value, text] of x.marks) {
    make(svg, "path", { d: `M${px(value)} ${TALL - BOTTOM}v5`, class: "zero" });
    make(svg, "text", { x: px(value), y: TALL - BOTTOM + 18, "text-anchor": "middle" }, text.slice(0, 34));
  }
  make(svg, "text", { x: WIDE - RIGHT, y: TALL - 6, "text-anchor": "end" }, xName);
  const kinds = hue ? [...new Set(data.rows.map((row) => shown(row[hue] ?? "none")))] : ["all cases"];
  data.rows.forEach((row) => {
    if ((row[xName] ?? null) === null || (row[yName] ?? null) === null) return;
    const colour = hue ? kinds.indexOf(shown(row[hue] ?? "none")) % 6 : 0;
    const dot = make(svg, "circle", { cx: px(row[xName]), cy: py(row[yName]), r: 4.5, class: `remark c${colour}` });
    make(dot, "title", {}, data.parameters.map((name) => `${name} = ${shown(row[name] ?? "none")}`).join("\n"));
  });
  kinds.slice(0, 12).forEach((kind, number) => {
    const key = make(names, "span"), swatch = make(key, "svg", { class: "swatch", viewBox: "0 0 30 10", "aria-hidden": "true" });
    make(swatch, "circle", { cx: 15, cy: 5, r: 4, class: `remark c${number % 6}` });
    make(key, "span", {}, hue ? `${hue} = ${kind}` : kind);
  });
}

theme();
if (Object.keys(data.numbers).length) {
  byId("response").hidden = false;
  for (const [name, label] of Object.entries(data.numbers)) make(byId("y"), "option", { value: name }, label);
  for (const name of data.parameters) make(byId("x"), "option", {}, name);
  make(byId("hue"), "option", { value: "" }, "nothing");
  for (const name of data.parameters) make(byId("hue"), "option", {}, name);
  if (data.parameters.length > 1) byId("hue").value = data.parameters[1];
  for (const name of ["x", "y", "hue"]) byId(name).addEventListener("change", draw);
  draw();
}
