// Hits of floes on the platform: which press at a time, which were the largest, what made a load.
import {lastNotAbove} from './run_data.js';

export class Hits {
  constructor(run) {
    this.run = run;
    this.refresh();
  }

  refresh() {
    const {run} = this;
    const get = name => run.column('events', name);
    const time = get('time');
    this.count = time.length;
    this.time = time;
    this.duration = get('duration');
    this.impulse = get('impulse');
    this.closing = get('closing_speed');
    const resolved = get('largest_force');  // runs of rigid ice have the crushing peak alone
    this.peak = resolved.length ? resolved : get('force_peak');
    this.windowImpulse = get('window_impulse');  // older files have none
    this.windowEnd = get('window_end');
    this.floe = Int32Array.from(get('body_b'), body => body - run.description.first_floe_body);
    this.end = Float64Array.from(time, (t, i) => t + this.lasts(i));
    this.force = Float64Array.from(time, (_, i) => this.impulse[i] / this.lasts(i));
    this.byStart = Int32Array.from(time, (_, i) => i).sort((a, b) => time[a] - time[b]);
    this.starts = Float64Array.from(this.byStart, i => time[i]);
    this.longest = this.end.reduce((most, end, i) => Math.max(most, end - time[i]), 0);
  }

  // Older files have one row for each time step and no duration. A touch lasts a time step at least.
  lasts(i) {
    return Math.max(this.duration[i] || 0, this.run.description.time_step_s);
  }

  // Hits that press at some time between `from` and `to`.
  during(from, to) {
    const found = [];
    for (let k = lastNotAbove(this.starts, from - this.longest); k < this.count && this.starts[k] <= to; ++k) {
      const i = this.byStart[k];
      if (this.end[i] >= from) found.push(i);
    }
    return found;
  }

  largest(values, count) {
    return Array.from({length: this.count}, (_, i) => i).sort((a, b) => values[b] - values[a]).slice(0, count);
  }

  // Time of the last touch of each floe before `time`; NaN for a floe that never touched.
  lastTouch(time, out) {
    out.fill(NaN);
    for (let k = 0; k < this.count && this.starts[k] <= time; ++k) {
      const i = this.byStart[k], floe = this.floe[i];
      if (floe < 0 || floe >= out.length) continue;
      const touch = Math.min(time, this.end[i]);
      if (!(out[floe] >= touch)) out[floe] = touch;
    }
    return out;
  }

  // The largest ice load of the run, over the force window: {time, force, x, y}; null without a platform.
  largestLoad() {
    const {run} = this;
    const time = run.column('platform', 'time');
    const x = run.column('platform', 'ice_force_mean_x'), y = run.column('platform', 'ice_force_mean_y');
    let best = -1, most = 0;
    for (let i = 0; i < x.length; ++i) {
      const size = Math.hypot(x[i], y[i]);
      if (size > most) [most, best] = [size, i];
    }
    return best < 0 ? null : {time: time[best], force: most, x: x[best], y: y[best]};
  }

  // Normal impulse of a hit between two times, as well as the file tells: its largest force window is known, the rest of
  // it is spread evenly over the rest of its time [N s].
  impulseBetween(i, from, to) {
    const common = (a, b) => Math.max(0, Math.min(to, b) - Math.max(from, a));
    const window = this.run.description.force_window_s, lasts = this.lasts(i);
    const within = common(this.time[i], this.end[i]), peak = this.windowImpulse[i];
    if (!(peak >= 0) || lasts <= window) return this.impulse[i] * within / lasts;
    const begin = Math.max(this.time[i], this.windowEnd[i] - window), end = Math.min(this.end[i], this.windowEnd[i]);
    const span = Math.max(end - begin, this.run.description.time_step_s), inPeak = Math.min(common(begin, end), within);
    const rest = Math.max(0, this.impulse[i] - peak) * (within - inPeak) / Math.max(lasts - span, 1e-9);
    return peak * inPeak / span + rest;
  }

  // The hits that pressed in the force window before `time`, largest first. `share`: of the load of that window, by the
  // impulse along it. A hit that pushes against the load has a share below zero.
  causes(time) {
    const {run} = this, window = run.description.force_window_s, from = time - window;
    const x = run.platformAt('ice_force_mean_x', time), y = run.platformAt('ice_force_mean_y', time), size = Math.hypot(x, y);
    const nx = run.column('events', 'nx'), ny = run.column('events', 'ny');
    const list = this.during(from, time).map(i => {
      const impulse = this.impulseBetween(i, from, time);
      const along = size > 0 ? -(nx[i] * x + ny[i] * y) / size : 0;  // the normal points from the platform into the ice
      return {hit: i, impulse, share: size > 0 ? along * impulse / (size * window) : 0};
    });
    return list.filter(one => one.impulse > 0).sort((a, b) => b.share - a.share);
  }
}
