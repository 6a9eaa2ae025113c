// The page of the studio: the whole workbench over the server that gave it.
import {ServerSource} from './server_source';
import {Store} from './store';
import {Workbench} from './workbench';
import {words} from './strings';
import {editorPanel} from './editor/editor';
import {paramsPanel} from './params/params';
import {outlinePanel} from './outline/outline';
import {changesPanel} from './changes/changes';
import {bindCorrections} from './truth/correct_menu';
import {partTools} from './truth/part_tools';
import {samplesPanel} from './truth/samples';
import {truthPanel} from './truth/truth';
import {scalePanel} from './scale/scale';
import {bindWelcome} from './shell/welcome';

const token = new URLSearchParams(location.search).get('token') ?? '';
const workbench = new Workbench(new ServerSource(token, (window as {firstState?: Promise<Response>}).firstState), new Store(), words.shell.title);
workbench.addLeft(editorPanel, paramsPanel, outlinePanel);
workbench.addRight(changesPanel, truthPanel, samplesPanel, scalePanel);
bindCorrections(workbench);
bindWelcome(workbench);
workbench.partTools = (part, answer) => partTools(workbench, part, answer);
// For scripts that drive the page, as the browser tests do.
Object.assign(window, {oriel: workbench});
void workbench.start();
