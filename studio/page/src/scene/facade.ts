// The side from which a building is best seen.
import {Vector3} from 'three';
import type {Shape} from '../source';
import {shownFeature} from './paint';
import {pointOf, polygonCount, ringsOf} from './shape';
import {normalOf} from './triangulate';

const kSides = 24;
/** What has a label is worth so many times its area of bare wall: a side of windows and doors is the main one. */
const kLabelled = 6;
const kSteep = 0.3;

/** The level direction outwards from the facade with the most of what is labelled, else of wall; null without walls. */
export function mainFacade(shape: Shape, labels: readonly number[] | undefined): Vector3 | null {
  const sums = Array.from({length: kSides}, () => new Vector3());
  for (let polygon = 0; polygon < polygonCount(shape); ++polygon) {
    const [x, y, z] = normalOf((ringsOf(shape, polygon)[0] ?? []).map(v => pointOf(shape, v)));
    if (Math.abs(z) > kSteep * Math.hypot(x, y)) continue;
    const weight = (labels?.[shownFeature(shape, polygon, labels)] ?? -1) >= 0 ? kLabelled : 1;
    const side = Math.round((Math.atan2(y, x) / (2 * Math.PI) + 1) * kSides) % kSides;
    sums[side]!.addScaledVector(new Vector3(x, y, 0), weight);
  }
  const best = sums.reduce((p, q) => (q.length() > p.length() * 1.001 ? q : p));
  return best.length() > 0 ? best.normalize() : null;
}
