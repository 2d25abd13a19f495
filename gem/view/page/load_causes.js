// What made a load: the hits that pressed, and where they explain less than half of it, the floes that lay at the platform.
import {Pose} from './run_data.js';

const reach = 0.25;  // metres: more than the page rounds, and than floes at rest move between two frames
export const leastShare = 0.05;  // of a load, for a floe that is marked

function segmentDistance(px, py, ax, ay, bx, by) {
  const ex = bx - ax, ey = by - ay;
  const along = Math.min(1, Math.max(0, ((px - ax) * ex + (py - ay) * ey) / (ex * ex + ey * ey || 1)));
  return Math.hypot(px - ax - along * ex, py - ay - along * ey);
}

// The corner of one outline that is nearest to the sides of another: {gap, x, y}.
function nearestCorner(corners, outline) {
  let best = {gap: Infinity, x: 0, y: 0};
  for (const [x, y] of corners) outline.forEach(([ax, ay], i) => {
    const [bx, by] = outline[(i + 1) % outline.length], gap = segmentDistance(x, y, ax, ay, bx, by);
    if (gap < best.gap) best = {gap, x, y};
  });
  return best;
}

const moved = (outline, x, y, cosine, sine) => outline.map(([u, v]) => [x + cosine * u - sine * v, y + sine * u + cosine * v]);

function outlineOf(shapes, i) {
  const outline = [];
  for (let k = shapes.start[i]; k < shapes.start[i + 1]; ++k) outline.push([shapes.xy[2 * k], shapes.xy[2 * k + 1]]);
  return outline;
}

// Floes that lie at the platform at a time, where a force (fx, fy) on it comes from; the largest first.
export function floesAtPlatform(run, time, fx, fy) {
  const {outline, pieces, present} = run.description.platform, {shapes} = run;
  if (!present || run.frameCount === 0) return [];
  const at = name => run.platformAt(name, time) || 0;
  const cx = at('x'), cy = at('y'), psi = at('psi');
  const hulls = pieces.map(piece => moved(piece, cx, cy, Math.cos(psi), Math.sin(psi)));
  const radius = Math.max(...outline.map(corner => Math.hypot(...corner)));
  const pose = new Pose(run);
  pose.moveTo(time);
  const found = [];
  for (let i = 0; i < shapes.floes; ++i) {
    if (!pose.there[i]) continue;
    const own = outlineOf(shapes, i), size = Math.max(...own.map(corner => Math.hypot(...corner)));
    if (Math.hypot(pose.x[i] - cx, pose.y[i] - cy) > radius + size + reach) continue;
    const there = moved(own, pose.x[i], pose.y[i], pose.cosine[i], pose.sine[i]);
    const touch = hulls.flatMap(hull => [nearestCorner(there, hull), nearestCorner(hull, there)])
        .reduce((a, b) => b.gap < a.gap ? b : a);
    if (touch.gap <= reach && (touch.x - cx) * fx + (touch.y - cy) * fy < 0) found.push(i);
  }
  return found.sort((i, j) => shapes.area[j] - shapes.area[i]);
}

// {hits: as Hits.causes(), explained: their share of the load, lying: floes that lay there if the hits explain too little,
// floes: those to be marked}.
export function loadCauses(run, hits, time) {
  const list = hits.causes(time), explained = list.reduce((sum, one) => sum + one.share, 0);
  const floes = list.filter(one => one.share >= leastShare).map(one => hits.floe[one.hit]);
  const force = ['x', 'y'].map(axis => run.platformAt(`ice_force_mean_${axis}`, time));
  const lying = explained < 0.5 ? floesAtPlatform(run, time, ...force).filter(floe => !floes.includes(floe)) : [];
  return {hits: list, explained, lying, floes: [...floes, ...lying]};
}
