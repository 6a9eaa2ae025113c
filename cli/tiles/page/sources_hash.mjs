// One hash of everything that the bundle is made from.
import {createHash} from 'node:crypto';
import {readFileSync, readdirSync} from 'node:fs';
import path from 'node:path';

export function sourcesHash(page) {
  const files = readdirSync(path.join(page, 'src')).map(name => `src/${name}`);
  files.push('bundle.mjs', 'package.json', 'page.html', 'sources_hash.mjs');
  const hash = createHash('sha256');
  for (const file of files.sort()) hash.update(file).update('\0').update(readFileSync(path.join(page, file))).update('\0');
  return hash.digest('hex');
}
