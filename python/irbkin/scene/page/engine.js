// Requests and answers as JSON text (src/page), answered in turn: by the crate as WebAssembly in a
// worker, by Python over HTTP, or by Python of a notebook. `connect` returns a function that takes a
// text and promises another.

class Engine {
  constructor(connect) {
    this.connect = connect;
    this.send = connect();
    this.before = [];
    this.last = Promise.resolve();
  }

  // The answer to a request; an error with a sentence if it is refused.
  ask(request) {
    const answer = this.last.then(() => this.answer(request));
    this.last = answer.catch(() => {});
    return answer;
  }

  // Ask for something that later answers depend on.
  async set(request) {
    const answer = await this.ask(request);
    this.before = [...this.before.filter((it) => it.do !== request.do), request];
    return answer;
  }

  async answer(request) {
    let answer = await this.tried(request);
    if (answer.lost) answer = await this.tried(request);
    return granted(answer);
  }

  // What answered may be gone with all that was set: another one is told again.
  async tried(request) {
    const answer = JSON.parse(await this.send(JSON.stringify(request)));
    if (answer.lost) for (const it of this.before) await this.send(JSON.stringify(it));
    return answer;
  }

  // Another one with the same state, which answers beside this one.
  twin() {
    const other = new Engine(this.connect);
    for (const it of this.before) other.set(it).catch(() => {});
    return other;
  }
}

function granted({ ok, error }) {
  if (error !== undefined) throw new Error(error);
  return ok;
}

// Bytes in base 85, four of them in five letters, as Python's b85encode has them, with . for <.
function unpacked(text) {
  const values = new Uint8Array(128);
  [..."0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%&()*+-;.=>?@^_`{|}~"]
    .forEach((it, value) => { values[it.charCodeAt(0)] = value; });
  const bytes = new DataView(new ArrayBuffer(4 * Math.ceil(text.length / 5)));
  for (let at = 0; at < text.length; at += 5) {
    let word = 0;
    for (let i = at; i < at + 5; i++) word = 85 * word + (i < text.length ? values[text.charCodeAt(i)] : 84);
    bytes.setUint32((at / 5) * 4, word);
  }
  return new Uint8Array(bytes.buffer, 0, Math.floor((4 * text.length) / 5));
}

// The crate in packed WebAssembly, in base 85.
async function wasmEngine(text) {
  const stream = new Blob([unpacked(text)]).stream().pipeThrough(new DecompressionStream("gzip"));
  const module = await WebAssembly.compile(await new Response(stream).arrayBuffer());
  return new Engine(() => {
    const script = `(${wasmWorker})()`;
    const worker = new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
    worker.postMessage(module);
    return (text) => new Promise((resolve, reject) => {
      worker.onmessage = ({ data }) => resolve(data);
      worker.onerror = ({ message }) => reject(new Error(message));
      worker.postMessage(text);
    });
  });
}

// The script of a worker: it is sent the module first, then requests.
function wasmWorker() {
  let module, instance;
  onmessage = ({ data }) => {
    if (!module) {
      module = data;
      return;
    }
    try {
      instance ??= new WebAssembly.Instance(module, {});
      const { memory, alloc, call, release } = instance.exports;
      const text = new TextEncoder().encode(data);
      const address = alloc(text.length);
      new Uint8Array(memory.buffer, address, text.length).set(text);
      const at = call(address, text.length);
      const size = new DataView(memory.buffer).getUint32(at, true);
      postMessage(new TextDecoder().decode(new Uint8Array(memory.buffer, at + 4, size)));
      release(at);
    } catch (fault) {
      // A trap leaves the memory as it was: a new instance takes over.
      instance = null;
      const error = `internal error, please report it: ${fault.message}`;
      postMessage(JSON.stringify({ lost: true, error }));
    }
  };
}

// Python, which served the page.
function servedEngine() {
  return new Engine(() => {
    const own = newName();
    return async (text) => (await post(`ask?${own}`, text)).text();
  });
}

const newName = () => Math.random().toString(36).slice(2);

async function post(path, text) {
  const answer = await fetch(path, { method: "POST", body: text }).catch(() => null);
  if (!answer || answer.status === 403) throw new Error("irbkin has ended: start irbkin view again");
  return answer;
}

// Share the joints with the Python that served the page: each side tells the other what it changes.
// What the page tells counts if it has `seen` all that Python told before.
function share(app, shown) {
  const own = newName();
  let [told, seen] = [[], 0];
  let isTelling, taking, stream;
  const untaken = {};
  const take = async () => {
    while (untaken.q) {
      const { scene, q, id } = untaken;
      Object.assign(untaken, { scene: null, q: null });
      const isOther = scene && JSON.stringify(scene) !== JSON.stringify(shown);
      if (isOther) await openScene(app, shown = scene).catch(({ message }) => app.notes.add(message));
      [told, seen] = [q, id];
      if (!same(q, app.state.q)) app.setJoints(q);
    }
  };
  const hear = ({ data, lastEventId: id }) => {
    Object.assign(untaken, JSON.parse(data), { id });
    taking ??= take().finally(() => { taking = null; });
  };
  // A browser has few streams: one that nobody looks at lets go of its own.
  const listen = () => {
    stream?.close();
    if (!document.hidden) stream = Object.assign(new EventSource(`events?${own}`), { onmessage: hear });
  };
  document.addEventListener("visibilitychange", listen);
  listen();
  app.options.onchange = async () => {
    if (isTelling) return;
    isTelling = true;
    while (told.length === app.state.q.length && !same(app.state.q, told)) {
      told = app.state.q;
      await post(`q?${own}&${seen}`, JSON.stringify(told)).catch(() => {});
    }
    isTelling = false;
  };
}
