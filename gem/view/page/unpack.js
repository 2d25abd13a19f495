// Reads the packets that gem/view/pack writes: numbers of variable length, kept as differences.

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// A packet: its description with the reader of its numbers as `numbers`.
export async function openPacket(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const size = view.getUint32(0, true);
  const packet = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + size)));
  packet.numbers = new NumberReader(await inflated(bytes.subarray(4 + size)));
  return packet;
}

export function bytesOfBase64(text) {
  const letters = atob(text.trim());
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

export class NumberReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  whole() {
    const first = this.bytes[this.at++];
    if (first < 128) return first;
    let value = first & 127, scale = 128;
    for (;;) {
      const next = this.bytes[this.at++];
      if (next === undefined) throw new Error('the data of this page end too early');
      value += (next & 127) * scale;
      if (next < 128) return value;
      scale *= 128;
    }
  }

  signed() {
    const first = this.bytes[this.at];
    if (first < 128) {
      ++this.at;
      return (first >>> 1) ^ -(first & 1);
    }
    const value = this.whole();
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  }

  // Turns over the flags that changed.
  changes(flags, base) {
    let at = base;
    for (let left = this.whole(); left > 0; --left) {
      at += this.whole();
      flags[at] = flags[at] ? 0 : 1;
    }
  }
}

// The shift that a mean speed foretells, by the same operations as in pack_frames.cpp.
function foretold(steps) {
  return Math.abs(steps) <= 1e9 ? Math.floor(steps + 0.5) : 0;
}

class FrameReader {
  constructor(packet) {
    this.packet = packet;
    this.floes = packet.floes;
    const size = packet.count * packet.floes;
    this.block = {first: packet.first, count: packet.count, there: new Uint8Array(size)};
    for (const name of ['x', 'y', 'theta', 'vx', 'vy', 'omega']) this.block[name] = new Int32Array(size);
  }

  read() {
    for (let n = 0; n < this.packet.count; ++n) this.frame(n);
    return this.block;
  }

  frame(n) {
    const {place_m, angle_rad, speed_m_per_s, spin_rad_per_s, time_s, turn_steps} = this.packet;
    const seconds = n === 0 ? 0 : time_s[n] - time_s[n - 1];
    const places = speed_m_per_s * seconds / (2 * place_m);
    const angles = spin_rad_per_s * seconds / (2 * angle_rad);
    this.flags(n);
    for (const speed of ['vx', 'vy', 'omega']) this.speed(n, this.block[speed]);
    this.place(n, this.block.x, this.block.vx, places, 0);
    this.place(n, this.block.y, this.block.vy, places, 0);
    this.place(n, this.block.theta, this.block.omega, angles, turn_steps);
  }

  flags(n) {
    const {there} = this.block;
    const base = n * this.floes;
    if (n > 0) there.copyWithin(base, base - this.floes, base);
    this.packet.numbers.changes(there, base);
  }

  speed(n, column) {
    const {there} = this.block, numbers = this.packet.numbers, floes = this.floes;
    for (let i = n * floes, end = i + floes; i < end; ++i) {
      const last = n > 0 ? column[i - floes] : 0;
      column[i] = there[i] ? last + numbers.signed() : last;
    }
  }

  // An angle is counted on over full turns, so that it can be interpolated; a first one is kept within one turn.
  place(n, column, speed, ratio, turn) {
    const {there} = this.block, numbers = this.packet.numbers, floes = this.floes;
    for (let i = n * floes, end = i + floes; i < end; ++i) {
      const last = n > 0 ? column[i - floes] : 0;
      if (!there[i]) {
        column[i] = last;
        continue;
      }
      const mean = speed[i] + (n > 0 ? speed[i - floes] : 0);
      const value = last + foretold(mean * ratio) + numbers.signed();
      column[i] = turn > 0 && Math.abs(value) > 1e9 ? value % turn : value;
    }
  }
}

export const readFrames = packet => new FrameReader(packet).read();

// Columns by name: {values, units, longName}. A missing value is NaN.
export function readRows(packet) {
  const columns = {};
  for (const {name, units, long_name, step, order} of packet.columns) {
    const missing = new Uint8Array(packet.count + 1);
    const turned = new Uint8Array(packet.count + 1);
    packet.numbers.changes(turned, 0);
    const values = new Float64Array(packet.count);
    let one = 0, two = 0, gap = 0;
    for (let i = 0; i < packet.count; ++i) {
      const base = order === 2 && i > 0 ? 2 * one - (i > 1 ? two : one) : one;
      two = one;
      one = base + packet.numbers.signed();
      gap ^= turned[i];
      missing[i] = gap;
      values[i] = gap ? NaN : one * step;
    }
    columns[name] = {values, units, longName: long_name};
  }
  return columns;
}

// Outlines in metres about the centroid, floe after floe, and one number for each floe of every column.
export function readShapes(packet) {
  const {floes, numbers} = packet;
  const start = new Uint32Array(floes + 1);
  for (let i = 0; i < floes; ++i) start[i + 1] = start[i] + numbers.whole();
  const xy = new Float32Array(2 * start[floes]);
  for (let i = 0; i < xy.length; ++i) xy[i] = numbers.signed() * packet.place_m;
  const shapes = {floes, start, xy};
  for (const {name, step} of packet.columns) {
    shapes[name] = new Float64Array(floes);
    for (let i = 0; i < floes; ++i) shapes[name][i] = numbers.signed() * step;
  }
  return shapes;
}
