// Line icons of 20 × 20, drawn with the colour of the text.
import {svg} from '../dom';

const paths: Record<string, string> = {
  theme: 'M10 3a7 7 0 1 0 0 14z M10 3a7 7 0 0 1 0 14',
  help: 'M7.6 7.4a2.5 2.5 0 1 1 3.6 2.3c-.8.4-1.2.9-1.2 1.8 M10 14.4v.2 M10 2.5a7.5 7.5 0 1 0 0 15 7.5 7.5 0 0 0 0-15',
  search: 'M8.5 3.5a5 5 0 1 0 0 10 5 5 0 0 0 0-10 M12.3 12.3l4.2 4.2',
  fit: 'M3.5 7.5v-4h4 M12.5 3.5h4v4 M16.5 12.5v4h-4 M7.5 16.5h-4v-4 M7.5 10l2.5-1.5 2.5 1.5v2.5h-5z',
  views: 'M10 3l6 3.2v7.2L10 17l-6-3.6V6.2z M4 6.2l6 3.3 6-3.3 M10 9.5V17',
  hidden: 'M4 6.5l6-3 6 3v7l-6 3-6-3z M4 6.5l6 3 6-3 M10 9.5v1 M10 12v1 M10 14.5v1',
  section: 'M3 13.5h14 M5 13.5V7l5-3.5 5 3.5v6.5 M6.5 16.5l1-1 M9.5 16.5l1-1 M12.5 16.5l1-1',
  measure: 'M3 13L13 3l4 4L7 17z M6 10l1.5 1.5 M8.5 7.5L11 10 M11 5l1.5 1.5',
  relations: 'M5 5.5a2 2 0 1 0 0 .1z M15 4a2 2 0 1 0 0 .1z M12 15a2 2 0 1 0 0 .1z M6.5 6.3l4 7 M6.9 5.3l6-1 M14.5 6l-2 7.2',
  changes: 'M3.5 7h10l-3-3 M16.5 13h-10l3 3',
  truth: 'M4 10.5l4 4 8-9',
  palette: 'M10 3a7 7 0 1 0 .5 14c1.6-.2.8-2 .8-2.7 0-1 .9-1.3 2-1.3H15c1.400-.1 2-1.300 2-3C17 5.800 14 3 10 3z M6.500 9.500v.1 M8.500 6.300v.1 M12 6.300v.1 M14 9v.1',
  close: 'M5.500 5.500l9 9 M14.500 5.500l-9 9',
  previous: 'M12 5l-5 5 5 5', next: 'M8 5l5 5-5 5', up: 'M5 12l5-5 5 5', down: 'M5 8l5 5 5-5',
  eye: 'M2.500 10S5.500 5 10 5s7.500 5 7.500 5-3 5-7.500 5-7.500-5-7.500-5z M10 8a2 2 0 1 0 0 4 2 2 0 0 0 0-4',
  eyeOff: 'M2.500 10S5.500 5 10 5s7.500 5 7.500 5-3 5-7.500 5-7.500-5-7.500-5z M4 16L16 4',
  warning: 'M10 3.500l7 12.500H3z M10 8v4 M10 14v.1'
};

export function icon(name: keyof typeof paths): SVGElement {
  return svg('svg', {viewBox: '0 0 20 20', class: 'icon', 'aria-hidden': 'true'}, svg('path', {d: paths[name]!}));
}
