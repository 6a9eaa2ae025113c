// One hash of everything that the bundles are made from.
import {createHash} from 'node:crypto';
import {readFileSync, readdirSync} from 'node:fs';
import path from 'node:path';

export function sourcesHash(page) {
  const files = readdirSync(path.join(page, 'src'), {recursive: true, withFileTypes: true}).filter(entry => entry.isFile())
    .map(entry => path.relative(page, path.join(entry.parentPath ?? entry.path, entry.name)));
  files.push('bundle.mjs', 'package.json', 'sources_hash.mjs', 'view.html');
  const hash = createHash('sha256');
  for (const file of files.sort()) hash.update(file).update('\0').update(readFileSync(path.join(page, file))).update('\0');
  return hash.digest('hex');
}
