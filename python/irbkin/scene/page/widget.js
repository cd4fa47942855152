// The page in a notebook, with the joints of Python's object.

// Python in the kernel, which is sent a message for each request.
function kernelEngine(model) {
  const waiting = new Map();
  model.on("msg:custom", ({ id, answer }) => {
    waiting.get(id)?.(answer);
    waiting.delete(id);
  });
  return new Engine(() => {
    const page = newName();
    return (text) => new Promise((resolve) => {
      const id = newName();
      waiting.set(id, resolve);
      model.send({ id, page, text });
    });
  });
}

function render({ model, el: host }) {
  const room = document.createElement("div");
  room.style.height = `${model.get("height")}px`;
  const look = document.createElement("style");
  look.textContent = STYLE;
  host.append(look, room);
  const show = async () => {
    const q = model.get("q");
    const app = await App.of(room, WASM ? await wasmEngine(WASM) : kernelEngine(model));
    await openScene(app, JSON.parse(model.get("scene")));
    await app.setJoints(q);
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
  };
  show().catch((fault) => {
    room.textContent = `irbkin does not start in this browser: ${fault.message}`;
  });
}

export default { render };
