// Parts by their ids and names, as `oriel explain` reads them: case, commas and the number of spaces do not count.
import type {Part} from '../source';

export const plain = (text: string) => text.toLowerCase().split(/[,\s]+/).filter(Boolean).join(' ');

/** Tests of an id or a name, from the strict to the lenient: all of it, its beginning by whole words, the beginning of an id, the
    beginning of a name by several words. */
export function matchesOf(text: string): ((name: string, isId: boolean) => boolean)[] {
  const meant = plain(text);
  if (!meant) return [];
  return [(id, isId) => isId && id === text, id => plain(id) === meant, id => plain(id).startsWith(`${meant} `), (id, isId) => isId && id.startsWith(text),
    id => meant.includes(' ') && plain(id).startsWith(meant)];
}

/** The first feature that passes the strictest of these tests that any passes. */
export function partByName(buildings: readonly (readonly {id: string; name: string}[])[], text: string): Part | null {
  for (const matches of matchesOf(text))
    for (let building = 0; building < buildings.length; ++building) {
      const feature = buildings[building]!.findIndex(({id, name}) => matches(id, true) || matches(name, false));
      if (feature >= 0) return [building, feature];
    }
  return null;
}
