// One Python for a page: questions in, answers out; stop() ends what it does at once and starts a fresh one.
let worker;
let waiting = new Map();
let last = 0;
const listeners = new Set();
let news = { part: 0, name: "" }; // the latest about the start of Python: {part, name}, {ready} or {error}

const tell = (newest) => {
  if (news.error) return; // the first error stays on the page
  news = newest;
  for (const listener of listeners) listener(news);
};

function start() {
  news = { part: 0, name: "" };
  worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
  worker.onmessage = ({ data }) => {
    if (data.progress) return tell(data.progress);
    waiting.get(data.id)?.(data);
    waiting.delete(data.id);
  };
  worker.onerror = (event) => {
    event.preventDefault();
    tell({ error: "prompt/worker.js, or a file that it imports, could not be loaded, or this browser has no module workers" });
    stopped(news.error);
  };
}

function stopped(reason) {
  const ended = [...waiting.values()];
  waiting = new Map();
  for (const resolve of ended) resolve({ stopped: true, text: `${reason}\n`, code: 130 });
}

export function ask(question) {
  if (!worker) start();
  return new Promise((resolve) => {
    waiting.set(++last, resolve);
    worker.postMessage({ id: last, ...question });
  });
}

export function stop() {
  worker?.terminate();
  start();
  stopped("stopped");
}

export function listen(listener) {
  listeners.add(listener);
  listener(news);
}

// The text of the status while Python starts; empty when it runs.
export const inWords = ({ part, name, error }) => {
  if (error) return `Python could not be started: ${error}`;
  return part < 1 ? `loading Python: ${Math.round(100 * part)} % ${name ? `(${name.split("/").pop()}) ` : ""}…` : "";
};

// The ANSI codes of a terminal as classes of the page.
const ANSI = /\x1b\[([\d;]*)m/g;

export function coloured(text) {
  const fragment = document.createDocumentFragment();
  let classes = [];
  let from = 0;
  const put = (part) => {
    if (!part) return;
    const span = document.createElement("span");
    span.className = classes.join(" ");
    span.textContent = part;
    fragment.append(span);
  };
  for (const match of text.matchAll(ANSI)) {
    put(text.slice(from, match.index));
    from = match.index + match[0].length;
    for (const code of match[1].split(";").map(Number)) {
      if (code === 0) classes = [];
      else classes.push(`ansi${code}`);
    }
  }
  put(text.slice(from));
  return fragment;
}

// A link that saves a file written by a line; for an SVG, the picture comes first.
export function linkTo({ name, content }) {
  const link = document.createElement("a");
  Object.assign(link, { href: URL.createObjectURL(new Blob([content])), download: name, textContent: `save ${name}` });
  if (!name.endsWith(".svg")) return [link, " "];
  const text = new TextDecoder().decode(content);
  const alt = new DOMParser().parseFromString(text, "image/svg+xml").querySelector("title").textContent;
  return [Object.assign(new Image(), { alt, src: `data:image/svg+xml,${encodeURIComponent(text)}` }), link, " "];
}
