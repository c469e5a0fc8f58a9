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
  for (const name of ["bridge.py", "orjson.py"])
    python.FS.writeFile(`/lib/site/${name}`, await (await fetch(`./${name}`)).text());
  python.runPython("import sys; sys.path.insert(0, '/lib/site'); import bridge; bridge.begin()");
  return python;
}

const ready = begin();
const toObject = (proxy) => {
  const value = proxy.toJs({ dict_converter: Object.fromEntries });
  proxy.destroy();
  return value;
};

// numpy lies beside Pyodide on this site, and comes the first time that a line needs it.
async function answer(python, bridge, line) {
  const first = toObject(bridge.run(line));
  if (!first.missing.length) return first;
  const silent = () => {};
  await python.loadPackage(first.missing, { messageCallback: silent, errorCallback: silent }).catch(silent);
  return toObject(bridge.run(line));
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
