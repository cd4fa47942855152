// The page in a notebook, with the joints of Python's object.

const same = (a, b) => a.length === b.length && a.every((it, i) => Math.abs(it - b[i]) < 1e-12);

function render({ model, el: host }) {
  const room = document.createElement("div");
  room.style.height = `${model.get("height")}px`;
  const look = document.createElement("style");
  look.textContent = STYLE;
  host.append(look, room);
  Engine.of(WASM).then((engine) => {
    const q = model.get("q");
    const app = new App(room, engine, {});
    app.open();
    openScene(app, JSON.parse(model.get("scene")));
    app.setJoints(q);
    app.options.onchange = (state) => {
      if (same(state.q, model.get("q"))) return;
      model.set("q", state.q);
      model.save_changes();
    };
    model.on("change:q", () => {
      const q = model.get("q");
      if (!same(q, app.state.q)) app.setJoints(q);
    });
    room.dataset.ready = "1";
  }).catch((fault) => {
    room.textContent = `irbkin does not start in this browser: ${fault.message}`;
  });
}

export default { render };
