// A studio that is opened for a step, in a folder of its own.
import {spawn} from 'node:child_process';
import {copyFileSync, mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';
import path from 'node:path';

const kSamples = path.resolve(path.dirname(new URL(import.meta.url).pathname), '../../../examples/samples');
const kPatienceMs = 20_000;

export class Studio {
  /// `files`: samples by name ("house.stripped.city.json"), copied into the folder; `texts`: more files, by name;
  /// `open`: what is opened, by default all files of buildings; `arguments`: more of the command line.
  static async open(oriel, {files = ['house.stripped.city.json'], texts = {}, open = null, arguments: more = []}) {
    const studio = new Studio();
    studio.folder = mkdtempSync(path.join(tmpdir(), 'oriel-studio-'));
    for (const file of files) copyFileSync(path.join(kSamples, file), path.join(studio.folder, file));
    for (const [name, text] of Object.entries(texts)) writeFileSync(path.join(studio.folder, name), text);
    const inputs = open ?? [...files, ...Object.keys(texts)].filter(name => name.includes('.city.json'));
    studio.#process = spawn(oriel, ['studio', ...inputs, '--no-browser', ...more], {cwd: studio.folder, stdio: ['ignore', 'pipe', 'pipe']});
    studio.#process.stderr.on('data', text => { studio.#log += text; });
    studio.#ended = new Promise(resolve => studio.#process.on('exit', resolve));
    studio.address = await studio.#firstLine();
    studio.origin = new URL(studio.address).origin;
    studio.token = new URL(studio.address).searchParams.get('token');
    return studio;
  }

  /// The answer to a verb, asked past the page.
  async ask(verb, body = {}) {
    const response = await fetch(`${this.origin}/api/${verb}`, {
      method: 'POST', headers: {'Content-Type': 'application/json', 'X-Oriel-Token': this.token}, body: JSON.stringify(body)
    });
    return {status: response.status, ...await response.json()};
  }

  path(name) { return path.join(this.folder, name); }
  get log() { return this.#log; }
  get pid() { return this.#process.pid; }

  /// What it said on stderr.
  async close() {
    this.#process.kill('SIGINT');
    const killer = setTimeout(() => this.#process.kill('SIGKILL'), kPatienceMs);
    await this.#ended;
    clearTimeout(killer);
    rmSync(this.folder, {recursive: true, force: true});
    return this.#log;
  }

  #process;
  #ended;
  #log = '';

  #firstLine() {
    return new Promise((resolve, reject) => {
      let text = '';
      const timer = setTimeout(() => reject(new Error('the studio prints no address')), kPatienceMs);
      this.#process.stdout.on('data', part => {
        text += part;
        const end = text.indexOf('\n');
        if (end < 0) return;
        clearTimeout(timer);
        resolve(text.slice(0, end));
      });
      this.#ended.then(() => reject(new Error(`the studio has ended: ${this.#log}`)));
    });
  }
}

/// A page of another site: a server on another port, which counts as another origin.
export async function openOtherSite(html) {
  const server = createServer((_, response) => response.writeHead(200, {'Content-Type': 'text/html'}).end(html));
  await new Promise(resolve => server.listen(0, '127.0.0.1', resolve));
  return {address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close()};
}
