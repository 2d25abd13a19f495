// The clock of the page: plays at a chosen speed, steps, loops.

export const speeds = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

export class Player {
  constructor(run, shown) {
    this.run = run;
    this.shown = shown;  // called with the time to show
    this.time = 0;
    this.speed = 50;
    this.playing = false;
    this.loops = true;
    this.lastTick = 0;
    this.changed = () => {};
  }

  play(on = !this.playing) {
    if (on && this.time >= this.run.end) this.time = 0;
    this.playing = on;
    this.lastTick = performance.now();
    if (on) requestAnimationFrame(() => this.tick());
    this.changed();
  }

  tick() {
    if (!this.playing) return;
    const now = performance.now();
    // a tab that was in the background does not leap
    this.time += Math.min(0.25, (now - this.lastTick) / 1000) * this.speed;
    this.lastTick = now;
    if (this.time >= this.run.end) {
      if (this.loops) this.time = 0;
      else this.play(false);
    }
    this.seek(this.time);
    if (this.playing) requestAnimationFrame(() => this.tick());
  }

  seek(time) {
    this.time = Math.min(this.run.end, Math.max(0, time));
    this.shown(this.time);
  }

  // To another frame of the file.
  step(frames) {
    this.play(false);
    const times = this.run.frameTimes;
    let n = times.findIndex(time => time > this.time + 1e-6) - 1;
    if (n < -1) n = times.length - 1;
    if (frames < 0 && times[n] < this.time - 1e-6) ++n;
    this.seek(times[Math.min(times.length - 1, Math.max(0, n + frames))] ?? 0);
  }
}
