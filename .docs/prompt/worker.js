// Python in a worker, so that the page does not freeze: contacts, lines and completions in, texts out.
import { loadPyodide } from "./pyodide/pyodide.mjs";

const here = (path) => new URL(path, self.location).href;
const send = (id, answer) => postMessage({ id, ...answer });

// Here fetch also counts the bytes that arrive, and names a file that cannot be loaded.
const plainFetch = self.fetch;
let loaded = 0;
let total = Infinity;
let told = 0; // when progress was last sent; Infinity when Python runs
let absent = ""; // the sentence about a file that could not be loaded
self.fetch = async (from, options) => {
  const name = String(from.url ?? from).replace(here("./"), "");
  const response = await plainFetch(from, options).catch(() => ({ status: "no answer, or not the pinned file" }));
  if (!response.ok) {
    absent = `prompt/${name} could not be loaded (${response.status})`;
    if (told < Infinity) postMessage({ progress: { error: absent } }); // Pyodide does not report every such file
    throw new Error(absent);
  }
  count(response.clone().body.getReader(), name);
  return response;
};
async function count(reader, name) {
  for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
    loaded += piece.value.length;
    if (performance.now() < told + 80 || absent || told === Infinity) continue;
    told = performance.now();
    postMessage({ progress: { part: Math.min(loaded / total, 0.99), name } });
  }
}
const bytes = async (path) => (await fetch(here(path))).arrayBuffer();
const unpack = async (python, wheel) => python.unpackArchive(await wheel, "zip", { extractDir: "/lib/site" });

async function begin() {
  const list = bytes("./python/index.json").then((text) => JSON.parse(new TextDecoder().decode(text)));
  list.then(({ bytes }) => (total = bytes));
  const own = list.then(({ own }) => bytes(`./python/${own}`));
  const scripts = { bridge: "bridge", explore: "explore", orjson: "orjson", page: "jkroll/pictures/page" };
  const [python, files, wheel, ...texts] = await Promise.all([
    loadPyodide({ indexURL: here("./pyodide/") }), list, own, ...Object.keys(scripts).map((name) => bytes(`./${name}.py`)),
  ]);
  await unpack(python, wheel);
  Object.values(scripts).forEach((path, n) => python.FS.writeFile(`/lib/site/${path}.py`, new Uint8Array(texts[n])));
  python.runPython("import sys; sys.path.insert(0, '/lib/site'); import bridge; bridge.begin()");
  told = Infinity;
  postMessage({ progress: { part: 1, ready: true } });
  return { python, files, bridge: python.pyimport("bridge") };
}

const ready = begin();
ready.catch((error) => absent || postMessage({ progress: { error: String(error.message ?? error) } }));

// Loaded when first needed: numpy, and the packages for tables.
const silent = () => {};
const loadNumpy = async (python) => {
  await python.loadPackage("numpy", { messageCallback: silent, errorCallback: silent });
  if (absent) throw new Error(absent);
};
let tables;
const loadTables = ({ python, files }) =>
  (tables ??= Promise.all(files.tables.map((name) => unpack(python, bytes(`./python/${name}`)))));

const toObject = (proxy) => {
  const value = proxy.toJs({ dict_converter: Object.fromEntries });
  proxy.destroy();
  return value;
};

async function answer(all, line) {
  await loadTables(all);
  let found = toObject(all.bridge.run(line));
  if (found.missing.length) {
    await loadNumpy(all.python);
    found = toObject(all.bridge.run(line));
  }
  return { ...found, files: found.written.map((name) => ({ name, content: all.python.FS.readFile(name) })) };
}

onmessage = async ({ data: { id, line, prefix, contact, drawn, file } }) => {
  try {
    const all = await ready;
    const { python, bridge } = all;
    if (contact !== undefined) send(id, { contact: JSON.parse(python.pyimport("explore").explore(JSON.stringify(contact))) });
    else if (drawn !== undefined) {
      await loadNumpy(python);
      send(id, { curve: JSON.parse(python.pyimport("explore").curve(JSON.stringify(drawn))) });
    } else if (line !== undefined) send(id, await answer(all, line));
    else if (prefix !== undefined) send(id, { words: toObject(bridge.candidates(prefix)) });
    else {
      if (file) python.FS.writeFile(file.name, file.content);
      send(id, { text: "", code: 0 });
    }
  } catch (error) {
    send(id, { text: `jkroll: ${absent || (error.message ?? error)}\n`, code: 1 });
    absent = "";
  }
};
