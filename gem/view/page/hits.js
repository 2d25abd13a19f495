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
    this.peak = get('force_peak');
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

  // The hits that pressed in the force window before `time`, with their share of the impulse, largest first.
  causes(time) {
    const from = time - this.run.description.force_window_s;
    const list = this.during(from, time).map(i => {
      const within = Math.min(time, this.end[i]) - Math.max(from, this.time[i]);
      return {hit: i, impulse: this.force[i] * Math.max(within, 0)};
    });
    const sum = list.reduce((total, one) => total + one.impulse, 0);
    for (const one of list) one.share = sum > 0 ? one.impulse / sum : 0;
    return list.sort((a, b) => b.impulse - a.impulse);
  }
}
