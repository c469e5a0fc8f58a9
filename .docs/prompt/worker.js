// Python in a worker, so that the page does not freeze: lines and completions in, texts out.
import { loadPyodide } from "./pyodide/pyodide.mjs";

const send = (id, answer) => postMessage({ id, ...answer });

async function begin() {
  const python = await loadPyodide({ indexURL: new URL("./pyodide/", self.location).href });
  const archives = await (await fetch("./python/index.json")).json();
  for (const name of archives) {
    const bytes = await (await fetch(`./python/${name}`)).arrayBuffer();
    python.unpackArchive(bytes, "zip", { extractDir: "/lib/site" });
  }
  python.FS.writeFile("/lib/site/bridge.py", await (await fetch("./bridge.py")).text());
  python.runPython("import sys; sys.path.insert(0, '/lib/site'); import bridge; bridge.begin()");
  return python;
}

const ready = begin();
const toObject = (proxy) => {
  const value = proxy.toJs({ dict_converter: Object.fromEntries });
  proxy.destroy();
  return value;
};

// numpy comes from Pyodide's own place, if there is a network, the first time that a line needs it.
async function answer(python, bridge, line) {
  const first = toObject(bridge.run(line));
  if (!first.missing.length) return first;
  const silent = () => {};
  await python.loadPackage(first.missing, { messageCallback: silent, errorCallback: silent }).catch(silent);
  const second = toObject(bridge.run(line));
  if (!second.missing.length) return second;
  const names = second.missing.join(" and ");
  return { text: `jkroll: this line needs ${names}, which could not be loaded: pip install jkroll\n`, code: 1 };
}

onmessage = async ({ data: { id, line, prefix } }) => {
  try {
    const python = await ready;
    const bridge = python.pyimport("bridge");
    if (line !== undefined) send(id, await answer(python, bridge, line));
    else if (prefix !== undefined) send(id, { words: toObject(bridge.candidates(prefix)) });
    else send(id, { text: "", code: 0 });
  } catch (error) {
    send(id, { text: `jkroll: ${error.message ?? error}\n`, code: 1 });
  }
};
