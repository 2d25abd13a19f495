// Mooring lines from above: as wide as their tension is large. A slack line is dashed, a broken one a stub at its anchor.
import {withUnit} from './dom.js';

// Widths in pixels; usual: at the largest tension of the start. Stub: share of a broken line that is drawn.
const lineStyle = {narrowest: 1, usual: 2.5, widest: 8, stub: 0.2};

// Horizontal pull and tension of a line over a horizontal distance, between the knots [distance m, pull N, tension N].
function curveAt(knots, distance) {
  let i = 0;
  while (i + 2 < knots.length && knots[i + 1][0] <= distance) ++i;
  const [a, b] = [knots[i], knots[i + 1] ?? knots[i]];
  const share = b[0] > a[0] ? Math.max(0, (distance - a[0]) / (b[0] - a[0])) : 0;
  return [1, 2].map(n => a[n] + share * (b[n] - a[n]));
}

// The lines at the time that is shown: {from, to, width, state, tension}, places in m.
export function linesNow(view) {
  const {lines, usual_tension_N: most} = view.run.description.mooring;
  if (lines.length === 0) return [];
  const {x, y, cosine, sine} = view.overlay.platformPose();
  return lines.map(({anchor_m: to, fairlead_m: [a, b], break_time_s, knots}) => {
    const from = [x + cosine * a - sine * b, y + sine * a + cosine * b];
    const apart = [from[0] - to[0], from[1] - to[1]];
    if (break_time_s > 0 && view.time >= break_time_s)
      return {from: [to[0] + lineStyle.stub * apart[0], to[1] + lineStyle.stub * apart[1]], to, width: 2, state: 'broken', tension: 0};
    const [pull, tension] = curveAt(knots, Math.hypot(...apart));
    const width = Math.min(lineStyle.widest, Math.max(lineStyle.narrowest, lineStyle.usual * tension / most));
    return {from, to, width, state: pull > 0 ? 'holds' : 'slack', tension};
  });
}

export const dashOf = state => state === 'holds' ? [] : state === 'slack' ? [6, 6] : [2, 4];

export function drawLines(context, view) {
  const {camera, theme} = view, lines = linesNow(view);
  for (const {from, to, width, state} of lines) {
    context.strokeStyle = state === 'broken' ? theme.chain : theme.mooring;
    context.lineWidth = width;
    context.setLineDash(dashOf(state));
    context.beginPath();
    context.moveTo(...camera.toScreen(...from));
    context.lineTo(...camera.toScreen(...to));
    context.stroke();
  }
  context.setLineDash([]);
  const strongest = lines.reduce((a, line, k) => line.tension > (lines[a]?.tension ?? 0) ? k : a, -1);
  if (strongest < 0) return;
  const {from, to, tension} = lines[strongest], [ux, uy] = camera.toScreen(...from), [vx, vy] = camera.toScreen(...to);
  const share = Math.min(0.5, 90 / Math.max(1, Math.hypot(vx - ux, vy - uy)));
  context.font = '12px sans-serif';
  context.textAlign = 'center';
  context.lineWidth = 3;
  context.strokeStyle = theme.panel;
  context.fillStyle = theme.mooring;
  const label = [`line ${strongest + 1}: ${withUnit(tension, 'N')}`, ux + share * (vx - ux), uy + share * (vy - uy) - 8];
  context.strokeText(...label);
  context.fillText(...label);
}
