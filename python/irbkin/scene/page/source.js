// The text of a module, with numbers of lines and what was found on them in its margin.

class Source {
  constructor(online) {
    this.online = online;
    this.text = el("textarea", {
      wrap: "off", spellcheck: false, ariaLabel: "text of the module", readOnly: true,
      onscroll: () => this.draw(),
    });
    this.margin = el("div", { className: "margin" });
    this.node = el("div", { className: "editor" }, this.margin, this.text);
    this.found = new Map();
    new ResizeObserver(() => this.draw()).observe(this.text);
  }

  open(text) {
    this.text.value = text;
    this.lines = text.split("\n").length;
    this.line = null;
    this.draw();
  }

  // Findings by their lines.
  mark(found) {
    this.found = found;
    this.draw();
  }

  // The line where the arm is.
  go(line) {
    if (line === this.line) return;
    this.line = line;
    const { clientHeight, scrollTop } = this.text;
    const top = (line - 1) * this.height();
    if (line && (top < scrollTop || top + this.height() > scrollTop + clientHeight)) {
      this.text.scrollTop = top - clientHeight / 2;
    }
    this.draw();
  }

  height() {
    return parseFloat(getComputedStyle(this.text).lineHeight) || 18;
  }

  // The lines that are seen: a module may have 100,000.
  draw() {
    const height = this.height();
    const first = Math.floor(this.text.scrollTop / height);
    const last = Math.min(this.lines ?? 0, first + Math.ceil(this.text.clientHeight / height) + 1);
    const rows = Array.from({ length: Math.max(last - first, 0) }, (_, i) => {
      const line = first + i + 1;
      const found = this.found.get(line) ?? [];
      const worst = SEVERITIES.find((it) => found.some((one) => one.severity === it)) ?? "";
      return el("div", {
        className: `${worst} ${line === this.line ? "here" : ""}`.trim(), onclick: () => this.online(line),
        title: found.map((it) => `${it.code} ${it.message}`).join("\n"),
      }, String(line));
    });
    this.margin.replaceChildren(...rows);
    this.margin.style.transform = `translateY(${first * height - this.text.scrollTop}px)`;
  }
}

const SEVERITIES = ["error", "warning", "note"];

// Bytes of a line that are shown before and behind an edit.
const AROUND = 200;

// The lines that edits change in a text of bytes, as they would be.
function corrected(bytes, edits) {
  const part = (from, to) => new TextDecoder().decode(bytes.subarray(from, to));
  const lines = new Map();
  for (const { begin, end, text } of [...edits].sort((a, b) => a.begin - b.begin)) {
    const from = Math.max(0, begin - AROUND);
    const start = from + bytes.subarray(from, begin).lastIndexOf(10) + 1;
    const { words, at } = lines.get(start) ?? { words: "", at: start };
    lines.set(start, { words: words + part(at, begin) + text, at: end });
  }
  return [...lines.values()].map(({ words, at }) => {
    const rest = part(at, at + AROUND).split("\n")[0];
    return (words + rest).trim();
  });
}
