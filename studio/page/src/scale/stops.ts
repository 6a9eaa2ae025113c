// The stops of the scale slider: the building as it is, the scales of maps, then the levels of detail.
import type {ScaleQuestion} from '../source';

export type Stop = {kind: 'scale'; scale: number} | {kind: 'lod'; lod: string};

export function stopsOf(scales: readonly number[]): Stop[] {
  return [...scales].sort((a, b) => a - b).map(scale => ({kind: 'scale', scale}));
}

export function isOriginal(stop: Stop): boolean { return stop.kind === 'scale' && stop.scale <= 1; }

export function keyOf(stop: Stop): string { return stop.kind === 'scale' ? `1:${stop.scale}` : `LoD ${stop.lod}`; }

export function questionOf(building: number, stop: Stop): ScaleQuestion {
  return stop.kind === 'scale' ? {building, scale: stop.scale} : {building, lod: stop.lod};
}

export function stopText(stop: Stop): string {
  return stop.kind === 'scale' ? `1:${stop.scale.toLocaleString('en')}` : `LoD ${stop.lod}`;
}

/** Below the slider there is room for the number alone. */
export function tickText(stop: Stop): string {
  if (stop.kind === 'lod') return stop.lod;
  return stop.scale < 10_000 ? String(stop.scale) : `${stop.scale / 1000}k`;
}
