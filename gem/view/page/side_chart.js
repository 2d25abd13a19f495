// Ice load per side of the platform: the impulse of all hits by the side that they met.
import {element, withUnit} from './dom.js';

// Angle of the outward normal of each side, from the outline, which is counter-clockwise.
function sideAngles(outline) {
  return outline.map(([x, y], i) => {
    const [nx, ny] = outline[(i + 1) % outline.length];
    return Math.atan2(x - nx, ny - y);
  });
}

// The side of each hit: the one whose normal is nearest to that of the hit, in the turned platform.
function sidesOfHits(run, hits) {
  const angles = sideAngles(run.description.platform.outline);
  const nx = run.column('events', 'nx'), ny = run.column('events', 'ny');
  return Int16Array.from(hits.time, (time, i) => {
    const angle = Math.atan2(ny[i], nx[i]) - (run.platformAt('psi', time) || 0);
    let best = 0, least = Infinity;
    angles.forEach((other, side) => {
      const apart = Math.abs(Math.atan2(Math.sin(angle - other), Math.cos(angle - other)));
      if (apart < least) [least, best] = [apart, side];
    });
    return best;
  });
}

export class SideChart {
  constructor(view) {
    this.view = view;
    this.canvas = element('canvas', {width: 300, height: 240, title: 'impulse of all hits by side of the platform'});
    this.note = element('p', {className: 'note'});
    this.box = element('div', {}, [this.canvas, this.note]);
  }

  refresh() {
    const {run, hits} = this.view;
    const outline = run.description.platform.outline;
    this.canvas.hidden = hits.count === 0;
    if (hits.count === 0) {
      this.note.textContent = 'No hits on the platform in this file.';
      return;
    }
    this.sides = sidesOfHits(run, hits);
    this.sums = new Float64Array(outline.length);
    this.sides.forEach((side, i) => this.sums[side] += hits.impulse[i] || 0);
    this.draw();
  }

  draw() {
    const {view, canvas, sums, sides} = this;
    if (!sums) return;
    const outline = view.run.description.platform.outline;
    const context = canvas.getContext('2d');
    const most = sums.reduce((a, b) => Math.max(a, b), 0) || 1, sum = sums.reduce((a, b) => a + b, 0) || 1;
    const [cx, cy] = [canvas.width / 2, canvas.height / 2];
    const radius = Math.max(...outline.map(([x, y]) => Math.hypot(x, y)));
    const unit = 48 / radius, bar = cy - 48 - 24;
    const now = new Set(view.hits.during(view.time, view.time).map(hit => sides[hit]));
    context.clearRect(0, 0, canvas.width, canvas.height);
    outline.forEach(([x, y], side) => {
      const [nx, ny] = outline[(side + 1) % outline.length];
      const grow = 1 + bar / 48 * sums[side] / most;
      context.beginPath();
      for (const [px, py, k] of [[x, y, 1], [nx, ny, 1], [nx, ny, grow], [x, y, grow]])
        context.lineTo(cx + px * unit * k, cy - py * unit * k);
      context.closePath();
      context.fillStyle = now.has(side) ? view.theme.load : view.theme.series_a;
      context.fill();
      context.strokeStyle = view.theme.panel;
      context.stroke();
    });
    context.fillStyle = view.theme.ink;
    context.font = '12px sans-serif';
    context.textAlign = 'center';
    const side = sums.indexOf(most);
    context.fillText(`${Math.round(100 * most / sum)} %`, cx, cy + 4);
    context.fillText('side ' + (side + 1), cx, cy + 20);
    this.note.textContent = `Impulse of hits, whole run: side ${side + 1} took ${withUnit(most, 'N s')} of ` +
        `${withUnit(sum, 'N s')}. Orange: pressed now. Current from the left is 0 degrees.`;
    const [vx, vy] = view.run.description.current_m_per_s;
    if (vx !== 0 || vy !== 0) this.note.textContent = this.note.textContent.replace(' Current from the left is 0 degrees.', '');
  }
}
