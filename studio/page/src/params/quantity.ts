// Quantities as packs write them: "0.6 m", "60 cm", "15 %", "0.35". Values of the interface are in metres, degrees and shares.

export interface WrittenUnit {
  unit: string;
  // What one of the unit is in metres, square metres, cubic metres, degrees or as a share.
  factor: number;
}

const factors = new Map<string, number>([
  ['', 1], ['m', 1], ['cm', 0.01], ['mm', 0.001], ['mm@map', 0.001], ['m2', 1], ['m3', 1], ['deg', 1], ['%', 0.01],
]);

// The unit that a quantity is written in; without one if it has none or an unknown one.
export function unitOf(text: string): WrittenUnit {
  const unit = /^\s*-?[\d.]+\s*(\S*)\s*$/.exec(text)?.[1] ?? "";
  const factor = factors.get(unit);
  return factor === undefined ? {unit: '', factor: 1} : {unit, factor};
}

// The step of a slider: 1, 2 or 5 times a power of ten, with about 200 steps over the range.
export function stepOf(from: number, to: number): number {
  const raw = (to - from) / 200;
  if (!(raw > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(raw));
  const steps = [1, 2, 5, 10];
  return (steps.find((step) => step * power >= raw * 0.999) ?? 10) * power;
}

// A number with as many decimals as its step needs, without trailing zeros.
export function numberText(value: number, step: number): string {
  const decimals = Math.min(6, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
  const text = value.toFixed(decimals);
  return decimals > 0 ? text.replace(/\.?0+$/, '') : text;
}

// A value of the interface as the pack would write it, in the unit of `like`.
export function written(value: number, like: WrittenUnit, step: number): string {
  const number = numberText(value / like.factor, step / like.factor);
  return like.unit === '' ? number : `${number} ${like.unit}`;
}

// What a person typed, as a value of the interface: a number in the unit of `like`, or with a unit of its own. Null if it is neither.
export function typedValue(text: string, like: WrittenUnit): number | null {
  const parts = /^\s*(-?\d+(?:\.\d+)?|-?\.\d+)\s*([a-z@%\d]*)\s*$/i.exec(text.replace(",", "."));
  if (!parts) return null;
  const unit = parts[2] === '' ? like.unit : parts[2];
  const factor = factors.get(unit ?? '');
  return factor === undefined ? null : Number(parts[1]) * factor;
}
