// The committed bundles are made from the committed sources.
//   node tests/studio/page/bundle_test.mjs
import {readFileSync} from 'node:fs';
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import {sourcesHash} from '../../../studio/page/sources_hash.mjs';

const page = path.join(path.dirname(fileURLToPath(import.meta.url)), '../../../studio/page');
const isSame = readFileSync(path.join(page, 'dist/sources.sha256'), 'utf8').trim() === sourcesHash(page);
console.log(isSame ? 'the bundles are of these sources' : 'studio/page/dist is older than its sources: run studio/page/bundle.sh and commit dist');
process.exit(isSame ? 0 : 1);
