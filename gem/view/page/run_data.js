// All that the page knows of a run: description, shapes, frames, rows. Grows while packets come in.
import {readContacts} from './chains.js';
import {readFrames, readRows, readShapes} from './unpack.js';

// Index of the last of ascending numbers that is not above `value`; 0 if all are.
export function lastNotAbove(numbers, value, count = numbers.length) {
  let low = 0, high = count;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (numbers[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return Math.max(0, low - 1);
}

export class RunData {
  constructor(description) {
    this.description = description;
    this.shapes = null;
    this.blocks = [];       // of frames, in order
    this.blockOfFrame = [];
    this.frameTimes = [];
    this.contacts = [];     // forces between bodies, of each frame
    this.platform = {};
    this.events = {};
    this.stats = {};
    this.nextRow = {platform: 0, events: 0, stats: 0};  // of the file
    this.listeners = [];
  }

  add(packet) {
    if (packet.kind === 'shapes') this.shapes = readShapes(packet);
    else if (packet.kind === 'frames') this.addFrames(packet);
    else if (packet.kind === 'rows') this.addRows(packet);
    else if (packet.kind === 'contacts' && packet.first === this.contacts.length) this.contacts.push(...readContacts(packet));
    for (const tell of this.listeners) tell(packet);
  }

  addFrames(packet) {
    if (packet.first !== this.frameTimes.length || packet.count === 0) return;
    const block = readFrames(packet);
    block.steps = packet;
    this.blocks.push(block);
    for (const time of packet.time_s) {
      this.frameTimes.push(time);
      this.blockOfFrame.push(block);
    }
  }

  addRows(packet) {
    const group = this[packet.group];
    if (packet.first !== this.nextRow[packet.group]) return;
    this.nextRow[packet.group] = packet.next;
    for (const [name, column] of Object.entries(readRows(packet))) {
      if (!group[name]) {
        group[name] = column;
        continue;
      }
      const joined = new Float64Array(group[name].values.length + column.values.length);
      joined.set(group[name].values);
      joined.set(column.values, group[name].values.length);
      group[name].values = joined;
    }
  }

  // Values of a column; empty if the file has none.
  column(group, name) {
    return this[group][name]?.values ?? [];
  }

  get frameCount() { return this.frameTimes.length; }

  // The forces between bodies in the frame nearest to a time; undefined if they were not recorded.
  contactsAt(time) {
    const {n, share} = this.between(time);
    return this.contacts[n + (share >= 0.5 ? 1 : 0)] ?? this.contacts[n];
  }

  get end() {
    const time = this.column('platform', 'time');
    return Math.max(this.frameTimes.at(-1) ?? 0, time[time.length - 1] ?? 0);
  }

  // The frame before `time`, and how far it is to the next: {n, share, seconds}.
  between(time) {
    const n = Math.min(lastNotAbove(this.frameTimes, time), Math.max(0, this.frameCount - 2));
    const seconds = (this.frameTimes[n + 1] ?? this.frameTimes[n]) - this.frameTimes[n];
    const share = seconds > 0 ? Math.min(1, Math.max(0, (time - this.frameTimes[n]) / seconds)) : 0;
    return {n, share, seconds};
  }

  // One value of a platform column at a time, between rows; NaN if there is none.
  platformAt(name, time) {
    const times = this.column('platform', 'time'), values = this.column('platform', name);
    if (values.length === 0) return NaN;
    const i = lastNotAbove(times, time);
    const j = Math.min(i + 1, values.length - 1);
    const seconds = times[j] - times[i];
    const share = seconds > 0 ? Math.min(1, Math.max(0, (time - times[i]) / seconds)) : 0;
    return values[i] + share * (values[j] - values[i]);
  }

  // Velocity of the 'current' or the 'wind' at a time [m/s]; null without wind.
  driveAt(name, time) {
    const {drive, duration_s} = this.description, rows = drive[`${name}_m_per_s`];
    if (!rows) return null;
    const place = rows.length > 1 ? Math.min(1, Math.max(0, time / duration_s)) * (rows.length - 1) : 0;
    const i = Math.min(Math.floor(place), rows.length - 1), j = Math.min(i + 1, rows.length - 1);
    return [0, 1].map(axis => rows[i][axis] + (place - i) * (rows[j][axis] - rows[i][axis]));
  }
}

// Where every floe is at a time: cubic between two frames, so that places and speeds are those of the frames.
export class Pose {
  constructor(run) {
    this.run = run;
    const floes = run.shapes.floes;
    for (const name of ['x', 'y', 'cosine', 'sine', 'vx', 'vy', 'omega']) this[name] = new Float64Array(floes);
    this.there = new Uint8Array(floes);
    this.time = NaN;
  }

  moveTo(time) {
    const {run} = this;
    this.time = time;
    if (run.frameCount === 0) return;
    const {n, share, seconds} = run.between(time);
    const a = run.blockOfFrame[n], b = run.blockOfFrame[n + 1] ?? a;
    const floes = run.shapes.floes;
    const from = (n - a.first) * floes;
    const to = b === a && run.frameCount < 2 ? from : (n + 1 - b.first) * floes;
    this.mix(a, from, b, to, share, seconds);
  }

  mix(a, from, b, to, s, seconds) {
    const step = a.steps, place = step.place_m, speed = step.speed_m_per_s, spin = step.spin_rad_per_s;
    const turn = step.turn_steps, radians = step.angle_rad;
    const s2 = s * s, s3 = s2 * s;
    const toB = 3 * s2 - 2 * s3, fromA = 1 - toB, slopeA = (s3 - 2 * s2 + s) * seconds, slopeB = (s3 - s2) * seconds;
    for (let i = 0; i < this.there.length; ++i) {
      const p = from + i, q = to + i;
      const thereB = b.there[q];
      this.there[i] = a.there[p] && (thereB || s === 0) ? 1 : (s === 1 ? thereB : 0);
      if (!this.there[i]) continue;
      const vx = a.vx[p] * speed, vy = a.vy[p] * speed, omega = a.omega[p] * spin;
      const wx = b.vx[q] * speed, wy = b.vy[q] * speed, psi = b.omega[q] * spin;
      this.x[i] = fromA * a.x[p] * place + toB * b.x[q] * place + slopeA * vx + slopeB * wx;
      this.y[i] = fromA * a.y[p] * place + toB * b.y[q] * place + slopeA * vy + slopeB * wy;
      // from one block to the next an angle may be counted from another turn: take the turn that the spin leads to
      let steps = b.theta[q] - a.theta[p];
      const expected = (omega + psi) / 2 * seconds / radians;
      steps -= turn * Math.round((steps - expected) / turn);
      const angle = (a.theta[p] + toB * steps) * radians + slopeA * omega + slopeB * psi;
      this.cosine[i] = Math.cos(angle);
      this.sine[i] = Math.sin(angle);
      this.vx[i] = vx + s * (wx - vx);
      this.vy[i] = vy + s * (wy - vy);
      this.omega[i] = omega + s * (psi - omega);
    }
  }
}
