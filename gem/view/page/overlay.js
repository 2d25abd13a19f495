// What lies over the floes: platform, channel, track, forces, marked floes, scale. Drawn by any 2D context.
import {eachChain} from './chains.js';
import {shortNumber} from './dom.js';
import {drawLines} from './lines.js';
import {platformForces} from './platform_forces.js';

const trackSeconds = 600;

function path(context, camera, outlines, x = 0, y = 0, cosine = 1, sine = 0) {
  context.beginPath();
  for (const outline of outlines) {
    outline.forEach(([cx, cy], k) => {
      const place = camera.toScreen(x + cosine * cx - sine * cy, y + sine * cx + cosine * cy);
      if (k === 0) context.moveTo(...place);
      else context.lineTo(...place);
    });
    context.closePath();
  }
}

// Returns whether it is long enough to be seen.
function arrow(context, from, to, colour) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const size = Math.hypot(dx, dy);
  if (size < 4) return false;
  const [ux, uy] = [dx / size, dy / size];
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = 3;
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(to[0] - 8 * ux, to[1] - 8 * uy);
  context.stroke();
  context.beginPath();
  context.moveTo(...to);
  context.lineTo(to[0] - 12 * ux - 6 * uy, to[1] - 12 * uy + 6 * ux);
  context.lineTo(to[0] - 12 * ux + 6 * uy, to[1] - 12 * uy - 6 * ux);
  context.fill();
  return true;
}

// A name beside the tip of an arrow; below the names that `taken` holds already.
function nameTip(context, from, to, name, halo, taken) {
  const line = 14, side = Math.sign(to[0] - from[0] || 1), x = to[0] + 8 * side;
  let y = to[1] + 4;
  for (const place of taken.sort((a, b) => a.y - b.y))
    if (place.side === side && Math.abs(place.x - x) < 70 && Math.abs(place.y - y) < line) y = place.y + line;
  taken.push({side, x, y});
  context.font = '12px sans-serif';
  context.textAlign = side < 0 ? 'right' : 'left';
  context.strokeStyle = halo;
  context.strokeText(name, x, y);
  context.fillText(name, x, y);
}

export class Overlay {
  constructor(view) {
    this.view = view;
  }

  draw(context) {
    const {camera, theme} = this.view;
    context.lineJoin = 'round';
    context.lineWidth = 1;
    for (const outline of this.view.run.description.fixed) {
      path(context, camera, [outline]);
      context.fillStyle = theme.fixed;
      context.strokeStyle = theme.ink;
      context.fill();
      context.stroke();
    }
    if (this.view.options.chains) this.drawChains(context);
    drawLines(context, this.view);
    if (this.view.run.description.platform.present) this.drawPlatform(context);
    this.drawMarks(context);
    this.drawDrive(context);
    this.drawScale(context);
  }

  drawChains(context) {
    const {camera, theme} = this.view;
    context.strokeStyle = theme.chain;
    context.lineCap = 'round';
    eachChain(this.view, (points, width) => {
      context.lineWidth = width;
      context.beginPath();
      for (const [x, y] of points) context.lineTo(...camera.toScreen(x, y));
      context.stroke();
    });
    context.lineCap = 'butt';
  }

  platformPose() {
    const at = name => this.view.run.platformAt(name, this.view.time);
    const psi = at('psi') || 0;
    return {x: at('x') || 0, y: at('y') || 0, cosine: Math.cos(psi), sine: Math.sin(psi)};
  }

  platformForces() {
    return platformForces(this.view.run, this.view.time);
  }

  drawPlatform(context) {
    const {camera, theme, run, options} = this.view;
    const pose = this.platformPose();
    path(context, camera, run.description.platform.pieces, pose.x, pose.y, pose.cosine, pose.sine);
    context.fillStyle = theme.platform;
    context.fill();
    context.lineWidth = this.view.selected === 'platform' ? 4 : 1.5;
    context.strokeStyle = this.view.selected === 'platform' ? theme.mark : theme.ink;
    context.stroke();
    if (options.track) this.drawTrack(context);
    if (options.forces) this.drawForces(context, pose);
  }

  drawTrack(context) {
    const {camera, theme, run, time} = this.view;
    const times = run.column('platform', 'time'), x = run.column('platform', 'x'), y = run.column('platform', 'y');
    context.strokeStyle = theme.track;
    context.lineWidth = 1.5;
    context.beginPath();
    let last = -Infinity;
    for (let i = 0; i < times.length && times[i] <= time; ++i) {
      if (times[i] < time - trackSeconds || times[i] - last < 0.5) continue;
      last = times[i];
      context.lineTo(...camera.toScreen(x[i], y[i]));
    }
    context.stroke();
  }

  // Arrows of the forces on the platform and of their sum: as long as the platform is wide at the largest force of the run.
  drawForces(context, pose) {
    const {camera, theme, run, largestForce} = this.view;
    const platform = run.description.platform;
    const metres = platform.diameter_m / Math.max(largestForce, 1);
    const centre = camera.toScreen(pose.x, pose.y), taken = [];
    for (const {name, colour, vector: [fx, fy]} of this.platformForces()) {
      const most = 2.5 * platform.diameter_m, size = Math.hypot(fx, fy) * metres, cut = size > most ? most / size : 1;
      const tip = camera.toScreen(pose.x + fx * metres * cut, pose.y + fy * metres * cut);
      if (arrow(context, centre, tip, theme[colour])) nameTip(context, centre, tip, name, theme.panel, taken);
    }
    const [ax, ay] = camera.toScreen(...platform.anchor_m);
    context.strokeStyle = theme.mooring;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(ax - 6, ay);
    context.lineTo(ax + 6, ay);
    context.moveTo(ax, ay - 6);
    context.lineTo(ax, ay + 6);
    context.stroke();
  }

  floePath(context, i) {
    const {camera, pose, run} = this.view, {start, xy} = run.shapes;
    const outline = [];
    for (let k = start[i]; k < start[i + 1]; ++k) outline.push([xy[2 * k], xy[2 * k + 1]]);
    path(context, camera, [outline], pose.x[i], pose.y[i], pose.cosine[i], pose.sine[i]);
  }

  // Floes that press on the platform now, those that made a load, and the selected one.
  drawMarks(context) {
    const {pose, theme, selected, causes, hits, time, options} = this.view;
    const outline = (i, colour, width) => {
      if (i < 0 || i >= pose.there.length || !pose.there[i]) return;
      this.floePath(context, i);
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.stroke();
    };
    if (options.forces) for (const hit of hits.during(time, time)) outline(hits.floe[hit], theme.load, 2);
    for (const floe of causes) outline(floe, theme.load, 3.5);
    if (Number.isInteger(selected)) {
      outline(selected, theme.mark, 4);
      if (pose.there[selected]) this.ring(context, pose.x[selected], pose.y[selected]);
    }
  }

  // A ring shows a marked floe that is too small to be seen.
  ring(context, x, y) {
    const {camera, theme} = this.view;
    context.beginPath();
    context.arc(...camera.toScreen(x, y), 18, 0, 2 * Math.PI);
    context.strokeStyle = theme.mark;
    context.lineWidth = 2;
    context.stroke();
  }

  // Current and wind at this time: where they go to, and how fast.
  drawDrive(context) {
    const {camera, theme, run, time} = this.view;
    const rows = ['current', 'wind'].map(name => [name, run.driveAt(name, time)]).filter(([, v]) => v && Math.hypot(...v) > 0);
    if (rows.length === 0) return;
    const left = camera.width - 158, top = camera.height - 54 - 32 * rows.length;
    context.fillStyle = theme.legend;
    context.fillRect(left, top, 150, 2 + 32 * rows.length);
    rows.forEach(([name, [vx, vy]], k) => {
      const speed = Math.hypot(vx, vy), [ux, uy] = [13 * vx / speed, -13 * vy / speed], [x, y] = [left + 20, top + 17 + 32 * k];
      arrow(context, [x - ux, y - uy], [x + ux, y + uy], name === 'wind' ? theme.track : theme.series_a);
      context.font = '12px sans-serif';
      context.fillStyle = theme.ink;
      context.textAlign = 'left';
      context.fillText(`${name} ${shortNumber(speed)} m/s`, left + 42, y + 4);
    });
  }

  drawScale(context) {
    const {camera, theme} = this.view;
    const metres = 10 ** Math.floor(Math.log10(160 / camera.scale));
    const length = [5, 2, 1].map(n => n * metres).find(m => m * camera.scale <= 160) ?? metres;
    const right = camera.width - 16, y = camera.height - 16;
    context.strokeStyle = context.fillStyle = theme.ink;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(right - length * camera.scale, y - 5);
    context.lineTo(right - length * camera.scale, y);
    context.lineTo(right, y);
    context.lineTo(right, y - 5);
    context.stroke();
    context.font = '12px sans-serif';
    context.textAlign = 'right';
    context.fillText(length >= 1000 ? `${length / 1000} km` : `${Number(length.toPrecision(1))} m`, right, y - 9);
  }
}
