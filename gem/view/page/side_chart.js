// Ice load per side of the platform: what each side of the outline took in the whole run. Side k runs from corner k to
// corner k + 1. Sides may differ in length: a bar stands on its side, and its height is the impulse.
import {element, shortNumber, withUnit} from './dom.js';

const size = {width: 300, height: 240, hull: 116, bar: 48};  // pixels
const labelsMaximum = 12;  // sides; of an outline with more, only the strongest is named

function sidesOf(pieces) {
  return pieces.flatMap(outline => outline.map(([x, y], i) => {
    const [toX, toY] = outline[(i + 1) % outline.length];
    const length = Math.hypot(toX - x, toY - y);
    return {x, y, toX, toY, length, nx: (toY - y) / length, ny: (x - toX) / length};
  }));
}

function distanceTo(side, x, y) {
  const ex = side.toX - side.x, ey = side.toY - side.y;
  const along = Math.min(1, Math.max(0, ((x - side.x) * ex + (y - side.y) * ey) / side.length ** 2));
  return Math.hypot(x - side.x - along * ex, y - side.y - along * ey);
}

// As side_of() in gem/geometry: of the sides that the point lies on, the one that faces the normal.
function sideOf(sides, radius, x, y, nx, ny) {
  const distances = sides.map(side => distanceTo(side, x, y));
  const reach = Math.min(...distances) + 0.01 * radius;
  let best = 0, facing = -2;
  sides.forEach((side, k) => {
    const cosine = side.nx * nx + side.ny * ny;
    if (distances[k] <= reach && cosine > facing) [facing, best] = [cosine, k];
  });
  return best;
}

// The side of each hit at its first touch, in the axes of the platform.
function sidesOfHits(run, hits, sides) {
  const radius = Math.max(...sides.map(side => Math.hypot(side.x, side.y)));
  const [x, y, nx, ny] = ['x', 'y', 'nx', 'ny'].map(name => run.column('events', name));
  return Int16Array.from(hits.time, (time, i) => {
    const at = name => run.platformAt(name, time) || 0;
    const psi = at('psi'), c = Math.cos(psi), s = Math.sin(psi), px = x[i] - at('x'), py = y[i] - at('y');
    return sideOf(sides, radius, c * px + s * py, c * py - s * px, c * nx[i] + s * ny[i], c * ny[i] - s * nx[i]);
  });
}

export class SideChart {
  constructor(view) {
    this.view = view;
    this.canvas = element('canvas', {width: size.width, height: size.height, title: 'impulse of the ice by side of the platform'});
    this.note = element('p', {className: 'note'});
    this.box = element('div', {}, [this.canvas, this.note]);
  }

  refresh() {
    const {run, hits} = this.view;
    const {outline, pieces, side_impulse: recorded} = run.description.platform;
    this.canvas.hidden = hits.count === 0 && !recorded?.some(sum => sum > 0);
    if (this.canvas.hidden) {
      this.note.textContent = 'No ice has pressed on the platform in this file.';
      return;
    }
    this.sides = sidesOf(pieces);
    this.hitSides = sidesOfHits(run, hits, this.sides);
    this.recorded = recorded;
    this.sums = Float64Array.from(recorded ?? outline.map(() => 0));
    if (!recorded) this.hitSides.forEach((side, i) => this.sums[side] += hits.impulse[i] || 0);
    this.draw();
  }

  nameOf(side) {
    return this.view.run.description.platform.side_names[side] ?? `side ${side + 1}`;
  }

  draw() {
    const {view, canvas, sums, sides} = this;
    if (!sums || canvas.hidden) return;
    const context = canvas.getContext('2d');
    const most = sums.reduce((a, b) => Math.max(a, b), 0) || 1, sum = sums.reduce((a, b) => a + b, 0) || 1;
    const xs = sides.map(side => side.x), ys = sides.map(side => side.y);
    const low = [Math.min(...xs), Math.min(...ys)], high = [Math.max(...xs), Math.max(...ys)];
    const unit = size.hull / Math.max(high[0] - low[0], high[1] - low[1]);
    const pixel = (x, y, out = 0, side = {nx: 0, ny: 0}) =>
        [canvas.width / 2 + (x - (low[0] + high[0]) / 2) * unit + out * side.nx,
         canvas.height / 2 - (y - (low[1] + high[1]) / 2) * unit - out * side.ny];
    const now = new Set(view.hits.during(view.time, view.time).map(hit => this.hitSides[hit]));
    const shape = (points, fill) => {
      context.beginPath();
      for (const point of points) context.lineTo(...point);
      context.closePath();
      context.fillStyle = fill;
      context.fill();
      context.stroke();
    };
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.strokeStyle = view.theme.panel;
    sides.forEach((side, k) => {
      const bar = size.bar * sums[k] / most;
      shape([pixel(side.x, side.y), pixel(side.toX, side.toY), pixel(side.toX, side.toY, bar, side), pixel(side.x, side.y, bar, side)],
            now.has(k) ? view.theme.load : view.theme.series_a);
    });
    shape(sides.map(side => pixel(side.x, side.y)), view.theme.platform);
    context.fillStyle = view.theme.ink;
    context.font = '11px sans-serif';
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    const strongest = sums.indexOf(most);
    sides.forEach((side, k) => {
      const share = Math.round(100 * sums[k] / sum);
      if (k !== strongest && (sides.length > labelsMaximum || share < 3)) return;
      const out = size.bar * sums[k] / most + 12;
      context.fillText(`${k + 1}: ${share} %`, ...pixel((side.x + side.toX) / 2, (side.y + side.toY) / 2, out, side));
    });
    this.note.textContent = this.text(strongest, sum);
  }

  text(strongest, sum) {
    const {sums, sides} = this;
    const order = Array.from(sides, (_, k) => k).sort((a, b) => sums[b] - sums[a]).slice(0, 3).filter(k => sums[k] > 0);
    const parts = order.map(k => `${k + 1} (${this.nameOf(k)}, ${shortNumber(sides[k].length)} m) ${withUnit(sums[k], 'N s')}`);
    const what = this.recorded ? 'Impulse of the ice' : 'Impulse of hits';
    return `${what}, whole run, ${withUnit(sum, 'N s')} in all. Sides, counter-clockwise: ${parts.join(', ')}. Orange: pressed now.` +
        (this.recorded ? '' : ' A hit counts for the side that it met first; output.side_loads = true records all of it.');
  }
}
