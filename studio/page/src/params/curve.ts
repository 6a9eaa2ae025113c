// The F1 of the truth against the values of one param: a line over the slider, with the present place and the best one.
import {svg} from '../dom';
import type {CurveAnswer} from '../source';

export const kCurveHeight = 40;
const kWidth = 1000;
const kMargin = 4;
/** A curve that hardly moves is drawn as flat as it is. */
const kLeastSpan = 0.02;

export interface Best { value: number; f1: number }

/** The value with the highest F1; of a plateau its middle, of several the one nearest to the present value. */
export function bestOf(curve: CurveAnswer): Best | null {
  if (curve.values.length === 0) return null;
  const f1 = Math.max(...curve.f1);
  let best: Best | null = null;
  for (let begin = 0; begin < curve.f1.length; ++begin) {
    if (curve.f1[begin]! < f1 - 1e-9) continue;
    let end = begin;
    while (end + 1 < curve.f1.length && curve.f1[end + 1]! >= f1 - 1e-9) ++end;
    const value = (curve.values[begin]! + curve.values[end]!) / 2;
    if (!best || Math.abs(value - curve.at) < Math.abs(best.value - curve.at)) best = {value, f1};
    begin = end;
  }
  return best;
}

/** F1 at a value: of the nearest one that was measured. */
export function f1At(curve: CurveAnswer, value: number): number | null {
  let nearest = -1;
  curve.values.forEach((other, at) => {
    if (nearest < 0 || Math.abs(other - value) < Math.abs(curve.values[nearest]! - value)) nearest = at;
  });
  return nearest < 0 ? null : curve.f1[nearest]!;
}

/** Draws a curve over [from, to]. Its width is stretched to that of the slider. */
export function drawCurve(curve: CurveAnswer, from: number, to: number): SVGElement {
  const low = Math.min(...curve.f1);
  const span = Math.max(Math.max(...curve.f1) - low, kLeastSpan);
  const x = (value: number) => (value - from) / (to - from) * kWidth;
  const y = (f1: number) => kCurveHeight - kMargin - (f1 - low) / span * (kCurveHeight - 2 * kMargin);
  const points = curve.values.map((value, at) => `${x(value).toFixed(1)},${y(curve.f1[at]!).toFixed(1)}`);
  const best = bestOf(curve);
  const line = svg('polyline', {points: points.join(' '), class: 'curve-line', 'vector-effect': 'non-scaling-stroke'});
  const first = curve.values[0] ?? from;
  const last = curve.values[curve.values.length - 1] ?? to;
  const area = svg('polygon', {points: `${x(first)},${kCurveHeight} ${points.join(' ')} ${x(last)},${kCurveHeight}`, class: 'curve-area'});
  const marks = best ? [svg('line', {
    x1: x(best.value), x2: x(best.value), y1: y(best.f1), y2: kCurveHeight, class: 'curve-best', 'vector-effect': 'non-scaling-stroke'
  })] : [];
  return svg('svg', {viewBox: `0 0 ${kWidth} ${kCurveHeight}`, preserveAspectRatio: 'none', class: 'curve', 'aria-hidden': 'true'}, area, line, ...marks);
}
