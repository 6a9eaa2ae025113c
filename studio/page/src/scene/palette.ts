// Which colour and which pattern a label has. The colours are in io/mesh/palette.json, for tiles and pictures, too.
import palette from '../../../../io/mesh/palette.json';

/** Patterns that materials.ts can draw: 0 is none. */
export const kPatterns = 9;

export interface Look { colour: string; pattern: number }

const usual = new Map(Object.entries(palette.usual));
const kColours = palette.labels.length;

/** Looks of the classes, in their order. A usual label keeps its colour in every pack; the others take what is left. After the last
    colour they begin again, told apart by a pattern even where only colours were asked for. */
export function looksOf(classes: readonly {name: string; is_abstract?: boolean}[], withPatterns: boolean): Look[] {
  const slots = new Map<string, number>();
  const taken = new Set<number>();
  for (const {name} of classes) {
    const slot = usual.get(name.toLowerCase().replaceAll('_', ' '));
    if (slot !== undefined && !taken.has(slot)) { slots.set(name, slot); taken.add(slot); }
  }
  let next = 0;
  // No part has the label of an abstract class.
  const inTurn = [...classes].sort((a, b) => Number(a.is_abstract ?? false) - Number(b.is_abstract ?? false));
  for (const {name} of inTurn) {
    if (slots.has(name)) continue;
    while (taken.has(next)) ++next;
    slots.set(name, next);
    taken.add(next);
  }
  return classes.map(({name}) => {
    const slot = slots.get(name)!;
    const round = Math.floor(slot / kColours);
    const pattern = withPatterns ? 1 + (slot + round) % (kPatterns - 1) : round === 0 ? 0 : 1 + (round - 1) % (kPatterns - 1);
    return {colour: palette.labels[slot % kColours]!, pattern};
  });
}

export const surfaceColours = palette.surfaces;

/** The colour of a share from 0 to 1 in the heat map. */
export function heatColour(share: number): string {
  const at = Math.max(0, Math.min(1, share)) * (palette.heat.length - 1);
  const from = rgb(palette.heat[Math.floor(at)]!), to = rgb(palette.heat[Math.ceil(at)]!);
  const mixed = from.map((c, i) => Math.round(c + (to[i]! - c) * (at - Math.floor(at))));
  return `#${mixed.map(c => c.toString(16).padStart(2, '0')).join('')}`;
}

export function rgb(colour: string): [number, number, number] {
  return [1, 3, 5].map(i => parseInt(colour.slice(i, i + 2), 16)) as [number, number, number];
}

/** A patch of the legend as CSS: the colour, and the pattern in white or dark lines over it. */
export function patchStyle(look: Look): Record<string, string> {
  const ink = luminance(look.colour) > 0.4 ? '#0009' : '#fffc';
  const stripes = (angle: number) => `repeating-linear-gradient(${angle}deg, ${ink} 0 1.5px, transparent 1.5px 5px)`;
  const dots = (size: number) => `radial-gradient(${ink} ${size}px, transparent ${size + 0.4}px) 0 0 / 5px 5px`;
  const layers = ['', stripes(45), stripes(135), stripes(0), stripes(90), dots(1.2), `${stripes(45)}, ${stripes(135)}`,
    `${stripes(0)}, ${stripes(90)}`, dots(1.9)][look.pattern];
  return {background: layers ? `${layers}, ${look.colour}` : look.colour, 'background-color': look.colour};
}

export function luminance(colour: string): number {
  const [r, g, b] = rgb(colour).map(c => (c / 255) ** 2.2) as [number, number, number];
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
