// A run button for each command in a console block or a table; the output appears below. A page has one Python.
import { ask, coloured, inWords, linkTo, listen, stop } from "./prompt/python.js";
const needsFiles = (command) =>
  /^(batch|fit) | (-o|--output|--plot|--data|--materials|--resume)[ =]/.test(`${command} `);

async function run(command, button, box, file) {
  const label = button.textContent;
  button.textContent = "stop";
  box.textContent = "working …";
  box.setAttribute("aria-busy", "true");
  listen((news) => box.ariaBusy === "true" && (box.textContent = inWords(news) || "working …"));
  if (file) await ask({ file });
  const { text, code, files = [] } = await ask({ line: command });
  box.setAttribute("aria-busy", "false");
  box.replaceChildren(coloured(text));
  box.after(...files.flatMap(linkTo));
  box.dataset.code = code;
  button.textContent = label;
}

function buttonOf(command, label, holder, file) {
  const button = document.createElement("button");
  button.textContent = label;
  button.title = `jkroll ${command}`;
  button.onclick = () => {
    if (button.textContent === "stop") return stop();
    const box = document.createElement("pre");
    Object.assign(box, { className: "ran", tabIndex: 0, ariaLabel: `what jkroll ${command} prints` });
    box.setAttribute("role", "log");
    holder.replaceChildren(box);
    run(command, button, box, file);
  };
  return button;
}

for (const block of document.querySelectorAll(".language-console.highlight")) {
  const every = [...block.textContent.matchAll(/^\$ jkroll (.+)$/gm)].map((match) => match[1].trim());
  const [, name, rows] = block.textContent.match(/^\s*\$ cat (\S+)\n((?:(?!\$ ).*\n)*)/) ?? []; // the table that it begins with
  const file = name && { name, content: new TextEncoder().encode(rows) };
  const commands = every.filter((each) => file || !needsFiles(each));
  const row = document.createElement("p");
  row.className = "run";
  const holder = document.createElement("div");
  row.append(...commands.map((each) => buttonOf(each, every.length > 1 ? `run ${each}` : "run", holder, file)));
  if (commands.length) block.after(row, holder);
}

for (const code of document.querySelectorAll("article td > code")) {
  const [, command] = code.textContent.match(/^jkroll (.+)$/) ?? [];
  if (!command || needsFiles(command)) continue;
  const place = document.createElement("span");
  place.className = "run";
  const row = code.closest("tr");
  const holder = row.parentElement.insertRow(row.sectionRowIndex + 1).insertCell();
  Object.assign(holder, { colSpan: row.cells.length, className: "ran" });
  place.append(buttonOf(command, "run", holder));
  code.after(" ", place);
}

// The copy button of a transcript copies what was typed: the text after $, >>> and ....
for (const block of document.querySelectorAll(".highlight")) {
  const typed = [...block.textContent.matchAll(/^(?:\$|>>>|\.\.\.)(?: (.*))?$/gm)].map((match) => match[1] ?? "");
  if (typed.length) block.dataset.copy = typed.join("\n");
}

// The keyboard can reach and scroll these boxes.
const reach = () => {
  for (const each of document.querySelectorAll("pre > code, .equation, .md-typeset__scrollwrap")) each.tabIndex = 0;
};
reach();
addEventListener("load", reach);

// To the search, a hyphen before a word means "without it", so `--load` is searched for as `load`.
document.querySelector(".md-search__input")?.addEventListener("input", ({ target }) => {
  target.value = target.value.replace(/(^|\s)-+(?=\w)/g, "$1");
});
