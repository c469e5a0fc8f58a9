// Each command of a console block gets a "run", which opens the prompt below the block with the line to edit.
const prompt = new URL("prompt/", new URL(".", document.querySelector("script[src*='run.js']").src));

for (const block of document.querySelectorAll(".language-console.highlight")) {
  const commands = [...block.textContent.matchAll(/^\$ jkroll (.+)$/gm)].map((match) => match[1].trim());
  const row = document.createElement("p");
  row.className = "run";
  for (const command of commands) {
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
  if (commands.length) block.after(row);
}
