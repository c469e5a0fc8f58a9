// Each command of a console block gets a "run", which prints below the block what the program says; one Python a page.
// The site's build puts FILES before this text: the options with which a line needs files, which a page does not have.
import { ask, coloured, inWords, listen, stop } from "./prompt/python.js";
const needsFiles = (command) =>
  command.startsWith("batch ") || command.split(/[ =]/).some((word) => FILES.includes(word));

async function run(command, button, box) {
  const label = button.textContent;
  button.textContent = "stop";
  box.textContent = "working …";
  box.setAttribute("aria-busy", "true");
  listen((news) => box.ariaBusy === "true" && (box.textContent = inWords(news) || "working …"));
  const { text, code } = await ask({ line: command });
  box.setAttribute("aria-busy", "false");
  box.replaceChildren(coloured(text));
  box.dataset.code = code;
  button.textContent = label;
}

for (const block of document.querySelectorAll(".language-console.highlight")) {
  const commands = [...block.textContent.matchAll(/^\$ jkroll (.+)$/gm)].map((match) => match[1].trim());
  const row = document.createElement("p");
  row.className = "run";
  for (const command of commands.filter((each) => !needsFiles(each))) {
    const button = document.createElement("button");
    button.textContent = commands.length > 1 ? `run ${command}` : "run";
    button.title = `jkroll ${command}`;
    button.onclick = () => {
      if (button.textContent === "stop") return stop();
      row.nextElementSibling?.matches("pre.ran") && row.nextElementSibling.remove();
      const box = document.createElement("pre");
      Object.assign(box, { className: "ran", tabIndex: 0, ariaLabel: `what jkroll ${command} prints` });
      box.setAttribute("role", "log");
      row.after(box);
      run(command, button, box);
    };
    row.append(button);
  }
  if (row.childElementCount) block.after(row);
}

// The copy button of a transcript copies what was typed: the lines behind $, >>> and ..., without these marks.
for (const block of document.querySelectorAll(".highlight")) {
  const typed = [...block.textContent.matchAll(/^(?:\$|>>>|\.\.\.)(?: (.*))?$/gm)].map((match) => match[1] ?? "");
  if (typed.length) block.dataset.copy = typed.join("\n");
}

// What scrolls by itself is reached by the keyboard.
const reach = () => {
  for (const each of document.querySelectorAll("pre > code, .md-typeset__scrollwrap")) each.tabIndex = 0;
};
reach();
addEventListener("load", reach);

// The search takes a hyphen before a word for "without it": `--load` is looked for as `load`.
document.querySelector(".md-search__input")?.addEventListener("input", ({ target }) => {
  target.value = target.value.replace(/(^|\s)-+(?=\w)/g, "$1");
});
