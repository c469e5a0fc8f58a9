// Each command of a console block gets a "run", which opens the prompt below the block with the line to edit.
// The site's build puts FILES before this text: the options with which a line needs files, which the prompt does not have.
const prompt = new URL("prompt/", new URL(".", document.querySelector("script[src*='run.js']").src));
const needsFiles = (command) =>
  command.startsWith("batch ") || command.split(/[ =]/).some((word) => FILES.includes(word));

for (const block of document.querySelectorAll(".language-console.highlight")) {
  const commands = [...block.textContent.matchAll(/^\$ jkroll (.+)$/gm)].map((match) => match[1].trim());
  const row = document.createElement("p");
  row.className = "run";
  for (const command of commands.filter((each) => !needsFiles(each))) {
    const button = document.createElement("button");
    button.textContent = commands.length > 1 ? `run ${command}` : "run";
    button.title = `jkroll ${command}`;
    button.onclick = () => {
      row.nextElementSibling?.matches("iframe.prompt") && row.nextElementSibling.remove();
      const frame = document.createElement("iframe");
      frame.className = "prompt";
      frame.title = "a prompt that runs jkroll";
      frame.src = `${prompt}?c=${encodeURIComponent(command)}`;
      row.after(frame);
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
