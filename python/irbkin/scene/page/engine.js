// The crate, compiled to WebAssembly: requests and answers are JSON (crates/page).

class Engine {
  constructor(module) {
    this.module = module;
    this.before = [];
  }

  static async of(base64) {
    const packed = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const bytes = await new Response(stream).arrayBuffer();
    const engine = new Engine(await WebAssembly.compile(bytes));
    await engine.start();
    return engine;
  }

  async start() {
    this.exports = (await WebAssembly.instantiate(this.module, {})).exports;
  }

  // The answer to a request; an error with a sentence if it is refused.
  ask(request) {
    const text = new TextEncoder().encode(JSON.stringify(request));
    let answer;
    try {
      const address = this.exports.alloc(text.length);
      new Uint8Array(this.exports.memory.buffer, address, text.length).set(text);
      const at = this.exports.call(address, text.length);
      const view = new DataView(this.exports.memory.buffer);
      const size = view.getUint32(at, true);
      answer = new TextDecoder().decode(new Uint8Array(this.exports.memory.buffer, at + 4, size));
      this.exports.release(at);
    } catch (fault) {
      // A trap leaves the memory as it was: a new instance takes over.
      this.exports = new WebAssembly.Instance(this.module, {}).exports;
      this.before.forEach((it) => this.ask(it));
      throw new Error(`internal error, please report it: ${fault.message}`);
    }
    const { ok, error } = JSON.parse(answer);
    if (error !== undefined) throw new Error(error);
    return ok;
  }

  // Ask for something that later answers depend on.
  set(request) {
    const answer = this.ask(request);
    this.before = [...this.before.filter((it) => it.do !== request.do), request];
    return answer;
  }
}
