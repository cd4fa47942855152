// Elements.

function el(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (key in made && key !== "list" && key !== "style") made[key] = value;
    else made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.flat().filter((it) => it !== null && it !== undefined));
  return made;
}

// A field for a number, which marks what is no number or beyond its bounds and keeps the rest going.
function numberField(label, { onvalue, bound = 1e6, step = () => 1 }) {
  const input = el("input", { type: "text", inputMode: "decimal", ariaLabel: label, spellcheck: false });
  const read = () => {
    const value = Number(input.value.trim().replace(",", "."));
    const wrong = input.value.trim() === "" || !Number.isFinite(value)
      ? "not a number"
      : Math.abs(value) > bound ? `at most ${bound}` : "";
    input.classList.toggle("wrong", Boolean(wrong));
    input.title = wrong ? `${label}: ${input.value} is ${wrong}` : "";
    return wrong ? null : value;
  };
  input.addEventListener("input", () => {
    const value = read();
    if (value !== null) onvalue(value);
  });
  input.addEventListener("keydown", (event) => {
    const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    const value = way && read();
    if (!way || value === null) return;
    event.preventDefault();
    input.value = String(Number((value + way * step() * (event.shiftKey ? 10 : 1)).toFixed(6)));
    onvalue(Number(input.value));
  });
  const show = (value, digits) => {
    if (document.activeElement !== input && input.getRootNode().activeElement !== input) {
      input.value = trimmed(value, digits);
      input.classList.remove("wrong");
    }
  };
  return { node: el("label", {}, el("span", {}, label), input), input, show };
}

// Six fields of a frame.
class FrameFields {
  constructor(title, units, onframe) {
    this.units = units;
    this.fields = ["x", "y", "z", "rz", "ry", "rx"].map((name, i) => numberField(name, {
      onvalue: (value) => this.changed(i, value, onframe),
      step: () => (units().length === "mm" ? 1 : name.length > 1 ? 0.01 : 0.001),
    }));
    this.node = el("div", { className: "frame", role: "group", ariaLabel: title },
      ...this.fields.map((it) => it.node));
    this.node.addEventListener("focusout", (event) => {
      if (this.node.contains(event.relatedTarget)) return;
      this.typed = false;
      if (this.pose) this.show(this.pose);
    });
  }

  // The fields beside it keep the digits that they do not show.
  changed(index, value, onframe) {
    if (this.fields.some((it) => it.input.classList.contains("wrong"))) return;
    this.numbers[index] = value;
    this.typed = true;
    const { toMeters, toRadians: turn } = this.units();
    onframe(fromEuler(this.numbers.slice(0, 3).map(toMeters), this.numbers.slice(3).map(turn)));
  }

  // While one of them is typed in, the others stay as they are: angles have more than one form.
  show(pose) {
    this.pose = pose;
    const root = this.node.getRootNode();
    if (this.typed && this.node.contains(root.activeElement)) return;
    this.typed = false;
    const { fromMeters, fromRadians, digits } = this.units();
    this.numbers = [...place(pose).map(fromMeters), ...toEuler(pose).map(fromRadians)];
    this.numbers.forEach((it, i) => this.fields[i].show(it, i < 3 ? digits[0] : digits[1]));
  }
}
