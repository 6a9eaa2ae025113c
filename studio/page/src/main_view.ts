// The page that `oriel view` writes: the same workbench without editor, over the replies that stand in the page; with --after a second
// picture behind a divider.
import {RecordedSource, type Pool} from './recorded_source';
import {Divider} from './scene/divider';
import {Store} from './store';
import {Workbench} from './workbench';
import {words} from './strings';

const source = new RecordedSource(JSON.parse(document.getElementById('data')?.textContent ?? '{}') as Pool);
const after = source.hasAfter ? source.after() : null;
const workbench = new Workbench(source, new Store(), words.shell.viewTitle);
void workbench.start().then(() => {
  if (after) new Divider(workbench).show(after.buildings, after.labels);
});
