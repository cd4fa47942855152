// The requests of a file, answered by the page in WebAssembly and compared with what the file
// expects: node wasm.mjs WASM FILE. An expected object has the fields that are compared, numbers
// may be 1e-9 off. Then requests that must be refused, and the time of a request.

import { readFileSync } from "node:fs";

const TOLERANCE = 1e-9;

/** The page in a file: a function from a request to its answer. */
async function load(path) {
    const { instance } = await WebAssembly.instantiate(readFileSync(path), {});
    const { memory, alloc, call, release } = instance.exports;
    const [encoder, decoder] = [new TextEncoder(), new TextDecoder()];
    const answerText = (text) => {
        const bytes = encoder.encode(text);
        const request = alloc(bytes.length) >>> 0;
        // The buffer of the memory is another one after it has grown.
        new Uint8Array(memory.buffer, request, bytes.length).set(bytes);
        const answer = call(request, bytes.length) >>> 0;
        const length = new DataView(memory.buffer).getUint32(answer, true);
        const read = decoder.decode(new Uint8Array(memory.buffer, answer + 4, length));
        release(answer);
        return read;
    };
    return {
        answerText,
        answer: (request) => JSON.parse(answerText(JSON.stringify(request))),
        bytes: () => memory.buffer.byteLength,
    };
}

/** The places at which an answer is not as expected. */
function differences(expected, found, place) {
    if (typeof expected === "number" && typeof found === "number") {
        const off = Math.abs(expected - found);
        return off <= TOLERANCE ? [] : [`${place}: ${found}, expected ${expected}`];
    }
    if (Array.isArray(expected) && Array.isArray(found) && expected.length === found.length) {
        return expected.flatMap((it, index) => differences(it, found[index], `${place}[${index}]`));
    }
    const isObject = (it) => it !== null && typeof it === "object" && !Array.isArray(it);
    if (isObject(expected) && isObject(found)) {
        const names = Object.keys(expected);
        return names.flatMap((name) => differences(expected[name], found[name], `${place}.${name}`));
    }
    const shown = (it) => JSON.stringify(it)?.slice(0, 200);
    return expected === found ? [] : [`${place}: ${shown(found)}, expected ${shown(expected)}`];
}

/** Requests that are refused, and words of the sentence. */
const REFUSED = [
    ["nonsense", "not JSON"],
    ['{"do": "ik", "T": [1e999]}', "out of range"],
    ['{"do": "sing"}', 'do is "sing", it must be catalog'],
    ['{"do": "fk", "q": [0, 1]}', "q has 2 numbers, it must have 6"],
    ['{"do": "fk", "q": [0, 0, 0, 0, 0, 1e7]}', "q[5] = 1e7, it must be at most 1e5"],
    ['{"do": "fk", "q": [0, 0, 0, 0, 0, "a"]}', "q[5] is a text, it must be a number"],
    ['{"do": "ik", "T": [1, 0, 0, 9e9, 0, 1, 0, 0, 0, 0, 1, 0]}', "T[3] = 9e9"],
    ['{"do": "ik", "T": [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]}', "T: "],
    ['{"do": "robot", "name": "IRB 2601"}', 'unknown robot "IRB 2601"'],
    ['{"do": "robot", "urdf": "<robot"}', ""],
    ['{"do": "cell", "obstacles": [{"name": "a", "shape": "cone"}]}', "obstacles[0].shape is"],
    [`{"do": "check", "modules": [{"text": "${" ".repeat(4000001)}"}]}`, "modules[0].text has 4000001 bytes"],
    ['{"do": "motion", "modules": [{"text": "MODULE A ENDMODULE"}]}', ""],
];

function refusals(page) {
    page.answer({ do: "robot", name: "IRB 2600-12/1.65" });
    return REFUSED.flatMap(([request, words]) => {
        const { error } = JSON.parse(page.answerText(request));
        const shown = request.slice(0, 80);
        return error?.includes(words) ? [] : [`${shown}: ${error}, expected "${words}"`];
    });
}

/** Microseconds of a request, the text of JSON made and read included. */
function time(page, request, count) {
    for (let warm = 0; warm < count / 10; warm++) page.answer(request);
    const start = performance.now();
    for (let run = 0; run < count; run++) page.answer(request);
    return (1e3 * (performance.now() - start)) / count;
}

const [wasm, file] = process.argv.slice(2);
const page = await load(wasm);
const cases = JSON.parse(readFileSync(file, "utf8"));
let robot = "";
const failed = [];
const times = [];
for (const { request, ok } of cases) {
    const answer = page.answer(request);
    if (request.do === "robot") robot = answer.ok?.name;
    const place = `${robot}, ${request.do}`;
    failed.push(...differences(ok, answer.ok ?? answer, place));
    if (["ik", "fk"].includes(request.do)) {
        const { collide, ...plain } = request;
        times.push(`${time(page, plain, 500).toFixed(1).padStart(8)} us  ${place}`);
    }
    if (["check", "motion", "robot"].includes(request.do)) {
        times.push(`${time(page, request, 20).toFixed(1).padStart(8)} us  ${place}`);
    }
}
failed.push(...refusals(page));
const { arms } = page.answer({ do: "catalog" }).ok;
if (arms.length < 100) failed.push(`the catalog has ${arms.length} arms`);
console.log(times.join("\n"));
console.log(`${time(page, { do: "catalog" }, 10).toFixed(1).padStart(8)} us  catalog`);
console.log(`${cases.length} requests compared, ${page.bytes() / 1e6} MB of memory`);
for (const words of failed.slice(0, 40)) console.error(words);
process.exit(failed.length > 0 ? 1 : 0);
