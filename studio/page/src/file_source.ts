// The source of a page that `oriel view` has written: everything is in the page, nothing can be asked for.
import {ServerSource} from './server_source';
export class FileSource extends ServerSource { constructor(_data: unknown) { super(''); } }
