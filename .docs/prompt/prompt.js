// The prompt: a line to type, its answer, history by arrow keys, completion by Tab, a link that carries the line.
import { ask, coloured, inWords, linkTo, listen, stop } from "./python.js";

const form = document.forms[0];
const byId = (id) => document.getElementById(id);
const [line, answer, status, choices, written] = ["line", "answer", "status", "choices", "written"].map(byId);
const go = form.querySelector("button");
listen((news) => (status.textContent = inWords(news)));

// --- A line and its answer ---

const history = JSON.parse(sessionStorage.getItem("history") ?? "[]");
let place = history.length;

async function run(text) {
  status.textContent = "working …";
  go.textContent = "stop";
  answer.setAttribute("aria-busy", "true");
  const found = await ask({ line: text });
  answer.replaceChildren(coloured(found.text));
  answer.raw = found.text;
  answer.setAttribute("aria-busy", "false");
  go.textContent = "run";
  answer.dataset.code = found.code;
  answer.dataset.line = text;
  written.replaceChildren(...(found.files ?? []).flatMap(linkTo));
  status.textContent = found.code ? `ended with code ${found.code}` : "";
}

form.onsubmit = (event) => {
  event.preventDefault();
  if (go.textContent === "stop") {
    stop();
    return given.forEach((file) => ask({ file })); // the fresh Python needs the files again
  }
  const text = line.value.trim();
  hide();
  if (!text) return;
  if (history.at(-1) !== text) history.push(text);
  place = history.length;
  sessionStorage.setItem("history", JSON.stringify(history.slice(-200)));
  window.history.replaceState(null, "", `?c=${encodeURIComponent(text)}`);
  run(text);
};

function recall(step) {
  place = Math.min(Math.max(place + step, 0), history.length);
  line.value = history[place] ?? "";
  line.setSelectionRange(line.value.length, line.value.length);
}

// --- Files: those given to the prompt, and those that a line wrote ---

const given = new Map();

async function give(files) {
  for (const each of files) {
    const file = { name: each.name, content: new Uint8Array(await each.arrayBuffer()) };
    given.set(file.name, file);
    await ask({ file });
    status.textContent = `${file.name} is here, for batch ${file.name} or fit ${file.name}`;
  }
}
byId("file").onchange = ({ target }) => give(target.files);
document.ondragover = (event) => event.preventDefault();
document.ondrop = (event) => (event.preventDefault(), give(event.dataTransfer.files));

// --- Completion ---

let chosen = -1;

function hide() {
  choices.replaceChildren();
  choices.hidden = true;
  chosen = -1;
  line.setAttribute("aria-expanded", "false");
  line.removeAttribute("aria-activedescendant");
}

function take(word) {
  line.value = line.value.slice(0, line.value.lastIndexOf(" ") + 1) + word + " ";
  hide();
  line.focus();
}

function choose(step) {
  const options = [...choices.children];
  chosen = (chosen + step + options.length) % options.length;
  options.forEach((option, n) => option.setAttribute("aria-selected", n === chosen));
  options[chosen].scrollIntoView({ block: "nearest" });
  line.setAttribute("aria-activedescendant", options[chosen].id);
}

async function complete() {
  const { words } = await ask({ prefix: line.value });
  if (!words?.length) return hide();
  if (words.length === 1) return take(words[0]);
  choices.replaceChildren(
    ...words.map((word, n) => {
      const option = document.createElement("li");
      Object.assign(option, { id: `choice${n}`, textContent: word, onclick: () => take(word) });
      option.setAttribute("role", "option");
      return option;
    }),
  );
  choices.hidden = false;
  chosen = -1;
  line.setAttribute("aria-expanded", "true");
  choose(1);
}

line.oninput = hide;
line.onkeydown = (event) => {
  const isOpen = !choices.hidden;
  const act = {
    ArrowUp: () => (isOpen ? choose(-1) : recall(-1)),
    ArrowDown: () => (isOpen ? choose(1) : recall(1)),
    Escape: isOpen && hide,
    Enter: isOpen && (() => take(choices.children[chosen].textContent)),
    // Tab completes a word that was begun, and leaves the line otherwise, as on any page.
    Tab: !event.shiftKey && (isOpen ? () => choose(1) : /\S$/.test(line.value) && complete),
  }[event.key];
  if (!act) return;
  event.preventDefault();
  act();
};

// --- Links and copies ---

async function copy(text, what) {
  await navigator.clipboard.writeText(text);
  status.textContent = `${what} copied`;
}
byId("copy").onclick = () => copy(`$ jkroll ${answer.dataset.line}\n${answer.textContent}`, "answer");
byId("link").onclick = () => copy(location.href, "link");

for (const example of document.querySelectorAll(".example"))
  example.onclick = () => {
    line.value = example.textContent;
    form.requestSubmit();
  };

// A line that came with a link is shown, and waits for a press.
const linked = new URLSearchParams(location.search).get("c")?.replace(/^jkroll /, "");
line.value = linked ?? line.value;
ask({}).then(async () => {
  if (linked === undefined) await run(line.value);
  else status.textContent = "this line came with the link: press run";
  document.body.dataset.ready = "yes";
});
