// What is drawn over the picture as SVG, so that it is sharp and can be read: relations, measures, marks of what changed, the name
// under the pointer.
import {Vector3} from 'three';
import {el, svg} from '../dom';
import type {BuildingScene} from './building_scene';

export interface OverlayLine { from: Vector3; to: Vector3; kind: 'relation' | 'measure'; label?: string }
export interface OverlayMark { at: Vector3; text: string; kind: 'change' | 'name' }

const kMostEdges = 500;

export class Overlay {
  private readonly root = svg('svg', {class: 'overlay', 'aria-hidden': 'true'});
  private readonly tip = el('div', {class: 'tip', hidden: true});
  private lines: OverlayLine[] = [];
  private marks: OverlayMark[] = [];
  private outline: [Vector3, Vector3][] = [];

  constructor(private readonly scene: BuildingScene) {
    scene.host.append(this.root, this.tip);
    scene.onRender.push(() => this.draw());
  }

  set(lines: OverlayLine[], marks: OverlayMark[]): void {
    this.lines = lines;
    this.marks = marks;
    this.draw();
  }

  /** The edges of what is chosen; far too many are left to the colour of its faces. */
  setOutline(outline: [Vector3, Vector3][]): void {
    this.outline = outline.length > kMostEdges ? [] : outline;
    this.draw();
  }

  /** A small text beside the pointer; null takes it away. */
  say(text: string | null, clientX = 0, clientY = 0): void {
    this.tip.hidden = text === null;
    if (text === null) return;
    this.tip.textContent = text;
    const area = this.scene.host.getBoundingClientRect();
    const x = Math.min(clientX - area.left + 14, area.width - this.tip.offsetWidth - 8);
    const y = Math.min(clientY - area.top + 18, area.height - this.tip.offsetHeight - 8);
    this.tip.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px)`;
  }

  private draw(): void {
    const shapes: Element[] = [];
    const names: {x: number; y: number; text: string}[] = [];
    const path = this.outline.map(([from, to]) => {
      const a = this.scene.project(from), b = this.scene.project(to);
      return a && b ? `M${a.x.toFixed(1)} ${a.y.toFixed(1)}L${b.x.toFixed(1)} ${b.y.toFixed(1)}` : '';
    }).join('');
    if (path) shapes.push(svg('path', {class: 'outline-halo', d: path}), svg('path', {class: 'outline', d: path}));
    for (const line of this.lines) {
      const a = this.scene.project(line.from), b = this.scene.project(line.to);
      if (!a || !b) continue;
      shapes.push(svg('line', {class: `line-${line.kind}`, x1: a.x, y1: a.y, x2: b.x, y2: b.y}));
      shapes.push(svg('circle', {class: `line-${line.kind}`, cx: b.x, cy: b.y, r: 3}));
      if (line.label) shapes.push(...textAt((a.x + b.x) / 2, (a.y + b.y) / 2, line.label, `label-${line.kind}`));
    }
    for (const mark of this.marks) {
      const p = this.scene.project(mark.at);
      if (!p) continue;
      if (mark.kind === 'change') shapes.push(svg('circle', {class: 'mark-change', cx: p.x, cy: p.y, r: 4}));
      else if (!hasRoom(p.x, p.y, mark.text, names)) continue;
      shapes.push(...textAt(p.x, p.y - 14, mark.text, `label-${mark.kind}`));
    }
    this.root.replaceChildren(...shapes);
  }
}

/** False if the name would lie upon one that is written already; else it is noted. */
function hasRoom(x: number, y: number, text: string, names: {x: number; y: number; text: string}[]): boolean {
  const kLetter_px = 6.5, kLine_px = 16;
  if (names.some(other => Math.abs(other.y - y) < kLine_px && Math.abs(other.x - x) < kLetter_px * (other.text.length + text.length + 2) / 2)) return false;
  names.push({x, y, text});
  return true;
}

/** A text with a halo, in the middle of a point. */
function textAt(x: number, y: number, text: string, kind: string): Element[] {
  const element = svg('text', {class: `overlay-text ${kind}`, x, y});
  element.textContent = text;
  return [element];
}
