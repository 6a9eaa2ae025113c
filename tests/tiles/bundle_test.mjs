// The committed page is made from the committed sources.
//   node tests/tiles/bundle_test.mjs
import {readFileSync} from 'node:fs';
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import {sourcesHash} from '../../cli/tiles/page/sources_hash.mjs';

const page = path.join(path.dirname(fileURLToPath(import.meta.url)), '../../cli/tiles/page');
const isSame = readFileSync(path.join(page, 'dist/sources.sha256'), 'utf8').trim() === sourcesHash(page);
console.log(isSame ? 'the page is of these sources' : 'cli/tiles/page/dist is older than its sources: run cli/tiles/page/bundle.sh and commit dist');
process.exit(isSame ? 0 : 1);
