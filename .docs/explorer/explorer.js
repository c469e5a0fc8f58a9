// The explorer: sliders, a sketch and a curve of a contact. Python computes every number; here they are only drawn.
import { ask, coloured, inWords, listen, stop } from "./prompt/python.js";

const $ = (id) => document.getElementById(id);
const NAMES = ["material", "material2", "radius", "radius2", "gamma", "young", "poisson", "density", "load", "xi", "speed", "model"];
const PREFIX = { "-15": "f", "-12": "p", "-9": "n", "-6": "u", "-3": "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T" };
const sliders = [...document.querySelectorAll("[data-of]")];
let found = JSON.parse($("first").textContent);
const FIRST = found.given;
let held = null; // the slider that is being dragged

// A position of a slider as an input with three digits.
function withUnit(value, unit) {
  if (!value) return `0${unit}`;
  const power = Math.min(Math.max(3 * Math.floor(Math.log10(Math.abs(value) * 1.0005) / 3), -15), 12);
  return `${Number((value / 10 ** power).toPrecision(3))}${PREFIX[power]}${unit}`;
}

// --- The contact: in the form, in the address, to Python and back ---

const read = () => Object.fromEntries(NAMES.map((name) => [name, $(name).value.trim()]));

function write(address) {
  const given = new URLSearchParams(address);
  for (const name of NAMES) $(name).value = given.get(name) ?? FIRST[name] ?? "";
  $("plane").checked = $("radius2").value === "plane";
}

function address() {
  const given = Object.entries(read()).filter(([name, text]) => text !== (FIRST[name] ?? ""));
  return given.length ? `?${new URLSearchParams(given)}` : location.pathname;
}

let last = {}; // steps of one input that follow one another within a second are one step of the history
function remember(name) {
  if (address() === (location.search || location.pathname)) return;
  const at = performance.now();
  history[name === last.name && at < last.at + 1000 ? "replaceState" : "pushState"](null, "", address());
  last = { name, at };
}

let wanted = null;
let isBusy = false;
let begun = 0; // when the oldest change that is not yet shown was made
async function update() {
  begun ||= performance.now();
  wanted = read();
  const given = Object.entries(wanted).filter(([, text]) => text);
  const isShown = given.length === Object.keys(found.given).length && given.every(([name, text]) => found.given[name] === text);
  $("explorer").classList.toggle("stale", !isShown);
  if (isBusy) return;
  isBusy = true;
  while (wanted) {
    const contact = wanted;
    const since = begun;
    [wanted, begun] = [null, 0];
    const answer = await ask({ contact });
    if (answer.contact) show(answer.contact);
    else if (answer.text && !answer.stopped) $("wrong").textContent = answer.text;
    performance.measure("change to numbers", { start: since, end: performance.now() });
    if (wanted || !answer.contact || answer.contact.error) continue; // the newest contact comes first
    const { curve } = await ask({ drawn: contact });
    if (curve && !wanted) drawCurve((found.curve = curve.lines));
  }
  isBusy = false;
  $("explorer").classList.remove("stale");
}

function show(answer) {
  for (const name of NAMES) $(name).removeAttribute("aria-invalid");
  $("wrong").textContent = answer.error ?? "";
  if (answer.input && $(answer.input)) $(answer.input).setAttribute("aria-invalid", "true");
  $("shell").textContent = answer.shell;
  $("python").textContent = answer.python;
  $("explorer").dataset.answered = JSON.stringify(answer.given);
  if (answer.error) return;
  found = { curve: found.curve, ...answer };
  place();
  numbers();
  sketch();
}

// --- Sliders and boxes ---

function place() {
  for (const name of ["poisson", "density"]) $(name).placeholder = found.inputs[name]?.text ?? "not known";
  for (const slider of sliders) {
    const name = slider.dataset.of;
    const { value, text } = found.inputs[name] ?? {};
    const forces = found.results.pull_off_force.number;
    slider.disabled = value == null || (name === "load" && !forces);
    $(name).placeholder = text ?? "not known";
    slider.setAttribute("aria-valuetext", text ?? "not known");
    if (slider === held || wanted || slider.disabled) continue; // an older answer moves no slider
    slider.value = name === "load" ? value / forces : Math.log10(value);
  }
}

for (const slider of sliders) {
  const name = slider.dataset.of;
  slider.setAttribute("aria-label", `${$(name).labels[0].textContent}, slider`);
  slider.oninput = (event) => {
    event.stopPropagation();
    held = slider;
    const x = Number(slider.value);
    const snapped = name === "load" && Math.abs(x) < 0.03 ? 0 : x;
    $(name).value = withUnit(name === "load" ? snapped * found.results.pull_off_force.number : 10 ** x, slider.dataset.unit);
    update();
  };
  slider.onchange = (event) => {
    event.stopPropagation();
    held = null;
    remember(name);
  };
}

function set(name, text) {
  $(name).value = text;
  $("plane").checked = $("radius2").value === "plane";
  remember(name);
  update();
}
$("inputs").oninput = ({ target }) => NAMES.includes(target.id) && update();
$("inputs").onchange = ({ target }) => NAMES.includes(target.id) && set(target.id, target.value);
$("inputs").onsubmit = (event) => event.preventDefault();
$("plane").onchange = () => set("radius2", $("plane").checked ? "plane" : "");
$("reset").onclick = () => {
  write("");
  remember("reset");
  update();
};

// --- Numbers and words ---

const element = (tag, text, ...inside) => {
  const made = Object.assign(document.createElement(tag), { textContent: text });
  made.append(...inside);
  return made;
};
const symbol = (text) => {
  const [head, foot] = text.split("_");
  return element("i", head, ...(foot ? [element("sub", foot)] : []));
};

function numbers() {
  for (const output of document.querySelectorAll("[data-result]")) {
    const { quantity, symbol: sign, best, by, value, law, reason } = found.results[output.dataset.result];
    output.title = quantity;
    const isNone = best === "–" && value === "–";
    output.classList.toggle("none", isNone);
    const below = isNone ? reason : `${by} · ${law} alone ${value}`;
    output.replaceChildren(symbol(sign), " ", element("b", isNone ? "–" : best === "–" ? value : best), element("small", below));
  }
  const reasons = found.doubts.map(({ text, ends }) => {
    const signs = ends.map((name) => found.results[name]?.symbol ?? name).join(", ");
    return element("li", "", ...(signs ? [element("b", `no meaning for ${signs}: `)] : []), text);
  });
  $("why").replaceChildren(
    ...reasons, ...Object.entries(found.why).map(([by, text]) => element("li", "", element("b", by), `: ${text}`)),
  );
  $("notes").replaceChildren(...found.notes.map((text) => element("li", text)));
}
const isApart = () => /beyond|breaks this contact/.test(found.results.contact_radius_at_load.reason);

// --- The sketch: what is larger is drawn larger, but not to scale ---

const FOOT = '<tspan dy="3" font-size="80%">c</tspan>';
const label = (x, y, text, kind = "") => `<text x="${x}" y="${y}" class="${kind}">${text}</text>`;

function arrow(x1, y1, x2, y2, kind) {
  const turn = Math.atan2(y2 - y1, x2 - x1);
  const tip = [2.6, -2.6].map((by) => `${x2 + 9 * Math.cos(turn + by)},${y2 + 9 * Math.sin(turn + by)}`);
  return `<path class="l ${kind}" d="M${x1},${y1}L${x2},${y2}M${tip[0]}L${x2},${y2}L${tip[1]}"/>`;
}

function ball(x, y, radius, side, half, sunk) { // side: 1 above the contact, -1 below; half: half the contact's width
  const far = Math.min(half * 1.3 + 9, radius * 0.93);
  const rise = Math.max(radius - sunk - Math.sqrt(radius ** 2 - far ** 2), 0);
  const tip = y - side * rise;
  const reach = (far - half) * 0.7;
  const [tx, ty] = [-Math.sqrt(radius ** 2 - far ** 2) / radius, (side * far) / radius];
  const neck = (s, back) => {
    const points = [[half, y], [half, y - side * rise * 0.55], [far + tx * reach, tip + ty * reach], [far, tip]].map(([px, py]) => `${x + s * px},${py}`);
    if (back) points.reverse();
    return `${points[0]} C${points[1]} ${points[2]} ${points[3]}`;
  };
  return `<path class="ball" d="M${neck(1)} A${radius},${radius} 0 1 ${side > 0 ? 0 : 1} ${x - far},${tip} L${neck(-1, true)} Z"/>`;
}

function sketch() {
  const { contact_radius_at_load: a, approach_at_load: d, pull_off_force: pull, yield_force: roll, reduced_radius: r } = found.results;
  const { radius, radius2 } = found.inputs;
  const [xi, load] = ["xi", "load"].map((name) => found.inputs[name] ?? { value: 0, text: "0" }); // absent if no result needs it
  const isPlane = radius2?.value == null;
  const [x, y] = [190, isPlane ? 190 : 150];
  const ratio = isPlane ? 1 : radius2.value / radius.value;
  const small = Math.max(61 * Math.max(ratio, 1 / ratio) ** -0.2, 26);
  const [p1, p2] = [Math.min(small * Math.max(1 / ratio, 1), 60000), isPlane ? 60000 : Math.min(small * Math.max(ratio, 1), 60000)];
  const reduced = (p1 * p2) / (p1 + p2);
  const part = a.number ? a.number / r.number : 0;
  const half = Math.min(Math.max(reduced * 1.35 * part ** 0.28, 7), small * 0.8);
  const depth = a.number ? Math.min(Math.max((half ** 2 / reduced) * ((d.number * r.number) / a.number ** 2), -22), small * 0.6) : isApart() ? -26 : 0;
  const bare = (kind) => `<circle class="${kind}" cx="${x}" cy="${y - p1 + depth / 2}" r="${p1}"/><circle class="${kind}" cx="${x}" cy="${y + p2 - depth / 2}" r="${p2}"/>`;
  const bodies = a.number ? ball(x, y, p1, 1, half, depth / 2) + ball(x, y, p2, -1, half, depth / 2) + bare("ghost") : bare("ball");
  const top = Math.max(y - 2 * p1 + depth / 2, 34);
  const force = load.value ? (load.value > 0 ? arrow(x, top - 30, x, top - 6, "") : arrow(x, top - 4, x, top - 30, "")) + label(x + 8, top - 14, `P = ${load.text}`) : "";
  const [up, down] = [y - Math.abs(depth) / 2, y + Math.abs(depth) / 2];
  const far = x - half - 14;
  const measures = a.number ? `<path class="thin" d="M${far - 6},${up}H${x}M${far - 6},${down}H${x}M${far},${up - 14}V${up}m-3,-5l3,5l3,-5M${far},${down + 14}V${down}m-3,5l3,-5l3,5"/>
    ${label(far - 9, y + 5, `δ = ${d.best}`, "end")}<path class="l" d="M${x},${y}h${half}"/>${label(x + half + 10, y + 5, `a = ${a.best}`)}` : label(x, y + 4, isApart() ? "apart" : "", "mid");
  const out = Math.min(p1, 104) + 6;
  const height = y - Math.min(p1, 96);
  const sideways = roll.best !== "–" && a.number ? arrow(x + out, height, x + out + 40, height, "roll") + label(394, height - 18, `Q ${roll.best}`, "end roll") : "";
  const upward = pull.best !== "–" ? arrow(26, 92, 26, 36, "pull") + label(6, 22, `P${FOOT}<tspan dy="-3"> ${pull.best}</tspan>`, "pull") : "";
  $("side").innerHTML = `<clipPath id="pane"><rect x="2" y="2" width="396" height="286" rx="7"/></clipPath><g clip-path="url(#pane)">${bodies}</g>${upward}${measures}${force}${sideways}${label(394, 282, "not to scale: the contact is exaggerated", "end pale title")}`;
  // From above: the circle has one size, and ξ is seen against it.
  const [cx, cy, size] = [108, 146, 74];
  const shift = Math.min(size * (a.number ? xi.value / a.number : 0) ** 0.6, 60);
  $("top").innerHTML = !a.number ? label(cx, cy, isApart() ? "no contact" : "size not known", "mid pale")
    : `<circle class="ring" cx="${cx}" cy="${cy}" r="${size}"/><circle class="rolled" cx="${cx + shift}" cy="${cy}" r="${size}"/>
    <path class="l" d="M${cx},${cy}h${-size}"/>${label(cx - size / 2, cy - 8, "a", "mid")}${arrow(cx + size - 1, cy, cx + size + Math.max(shift, 4), cy, "roll")}
    ${label(cx + 8, 26, "the contact from above", "mid title")}${label(cx + 8, cy + size + 28, `it lags by ξ = ${xi.text},`, "mid roll")}${label(cx + 8, cy + size + 46, "then it rolls", "mid roll")}`;
}

// --- The curve ---

const [LEFT, RIGHT, TOP, BOTTOM] = [64, 620, 12, 196];
const scale = ([low, high], from, to) => (value) => from + ((value - low) / (high - low)) * (to - from);
const range = (values) => [Math.min(...values), Math.max(...values)];
let stable; // the points of the stable branch for dragging: x on the screen, and load

function drawCurve(lines) {
  const { pull_off_force: pull, approach_at_load: d } = found.results;
  const load = found.inputs.load ?? { value: 0 };
  const points = Object.values(lines).flat().filter(Boolean);
  $("plotted").textContent = `load against approach, by ${pull.law}; drag the point`;
  if (!points.length || !pull.number) return ($("curve").innerHTML = label(320, 110, "needs Young’s modulus and Poisson’s ratio", "mid pale"));
  const x = scale(range(points.map(([at]) => at)), LEFT + 6, RIGHT);
  const y = scale([-1.15 * pull.number, Math.max(...points.map(([, force]) => force))], BOTTOM, TOP);
  stable = (lines.stable ?? points).filter(Boolean).map(([at, force]) => [x(at), force]);
  const path = (line) => line.map((point, n) => (point ? `${line[n - 1] ? "L" : "M"}${x(point[0]).toFixed(1)},${y(point[1]).toFixed(1)}` : "")).join("");
  const drawn = Object.entries(lines).map(([name, line]) => `<path class="l ${name === "stable" || lines.stable === undefined ? "" : "loose"}" d="${path(line)}"/>`);
  const least = stable[0][0];
  $("curve").innerHTML = `<path class="axis" d="M${LEFT},${y(0)}H${RIGHT}M${x(0)},${TOP}V${BOTTOM}"/><path class="thin dash" d="M${LEFT},${y(-pull.number)}H${RIGHT}"/>
    ${label(RIGHT, Math.min(y(-pull.number) + 15, BOTTOM + 3), `hardest pull by ${pull.law}: ${pull.value}`, "pull end")}${label(LEFT - 4, y(0) + 4, "P = 0", "end pale")}${label(x(0), BOTTOM + 20, "δ = 0", "mid pale")}
    ${label(RIGHT, BOTTOM + 20, `approach δ →`, "end pale")}${label(LEFT - 4, TOP + 8, "press", "end pale")}${label(LEFT - 4, y(-pull.number) + 4, "pull", "end pull")}${drawn.join("")}<circle class="here pull" cx="${least}" cy="${y(stable[0][1])}" r="5"/>
    ${d.number != null ? `<circle class="here" cx="${x(d.number)}" cy="${Math.max(y(load.value), 8)}" r="8"/>${label(x(d.number) + 14, Math.max(y(load.value), 8) + 16, `${d.value} by ${d.law}`)}` : ""}`;
}

function drag(event) {
  const box = $("curve").getBoundingClientRect();
  const x = ((event.clientX - box.left) / box.width) * 640;
  const next = stable?.findIndex(([at]) => at >= x) ?? -1;
  if (!stable) return;
  const [[x0, low], [x1, high]] = next < 0 ? [stable.at(-1), stable.at(-1)] : [stable[Math.max(next - 1, 0)], stable[next]];
  const load = x1 > x0 ? low + ((x - x0) / (x1 - x0)) * (high - low) : high;
  $("load").value = withUnit(Math.max(load, -0.994 * found.results.pull_off_force.number), "N");
  update();
}
$("curve").onpointerdown = (event) => ($("curve").setPointerCapture(event.pointerId), drag(event));
$("curve").onpointermove = (event) => $("curve").hasPointerCapture(event.pointerId) && drag(event);
$("curve").onpointerup = () => remember("load");

// --- Python, the command, copies ---

listen((news) => {
  const { part, ready, error } = news;
  $("state").classList.toggle("error", Boolean(error));
  $("bar").hidden = Boolean(ready || error);
  if (part) $("bar").value = part;
  $("status").textContent = ready ? "live: Python in this page; nothing leaves it" : `${inWords(news)}${error ? ". The" : " until then, the"} numbers are those of the first contact`;
});

let isRunning = false;
$("run").onclick = async () => {
  if (isRunning) return stop();
  isRunning = true;
  $("run").textContent = "stop";
  const { text } = await ask({ line: $("shell").textContent });
  $("printed").hidden = false;
  $("printed").replaceChildren(coloured(text));
  isRunning = false;
  $("run").textContent = "run";
};
$("calls").onclick = async ({ target }) => {
  const what = target.dataset?.copy;
  if (!what) return;
  await navigator.clipboard.writeText(what === "link" ? location.href : $(what).textContent);
  $("status").textContent = `${{ link: "link", shell: "command", python: "call" }[what]} copied`;
};
window.onpopstate = () => {
  write(location.search);
  update();
};

write("");
show(found);
drawCurve(found.curve);
write(location.search);
update();
