// The text of a module, with numbers of lines and what was found on them in its margin.

class Source {
  constructor({ onchange, online }) {
    this.online = online;
    this.text = el("textarea", {
      wrap: "off", spellcheck: false, ariaLabel: "text of the module", autocapitalize: "off",
      oninput: () => { this.count(); onchange(this.text.value); },
      onscroll: () => this.draw(),
    });
    this.margin = el("div", { className: "margin" });
    this.node = el("div", { className: "editor" }, this.margin, this.text);
    this.found = new Map();
    new ResizeObserver(() => this.draw()).observe(this.text);
  }

  open(text, readOnly = false) {
    this.text.value = text;
    this.text.readOnly = readOnly;
    this.line = null;
    this.count();
  }

  count() {
    this.lines = this.text.value.split("\n").length;
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

// A text after edits, whose places are bytes; of those at one place the first counts.
function edited(text, edits) {
  const bytes = new TextEncoder().encode(text);
  const part = (from, to) => new TextDecoder().decode(bytes.subarray(from, to));
  let copied = 0;
  const parts = [...edits].sort((a, b) => a.begin - b.begin).flatMap((it) => {
    if (it.begin < copied) return [];
    const before = part(copied, it.begin);
    copied = it.end;
    return [before, it.text];
  });
  return [...parts, part(copied)].join("");
}
