// The page that `oriel view` writes: the same workbench without editor, over the data that stand in the page.
import {FileSource} from './file_source';
import {Store} from './store';
import {Workbench} from './workbench';
import {words} from './strings';

const data = JSON.parse(document.getElementById('data')?.textContent ?? '{}');
const workbench = new Workbench(new FileSource(data), new Store(), words.shell.viewTitle);
void workbench.start();
