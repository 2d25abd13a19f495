// Which part of the sea is seen: centre in metres and pixels for each metre. y points up.

export class Camera {
  constructor() {
    this.x = 0;
    this.y = 0;
    this.scale = 1;
    this.width = 1;
    this.height = 1;
    this.follows = false;
  }

  // Shows a box [x0, y0, x1, y1] with a margin.
  fit([x0, y0, x1, y1]) {
    this.x = (x0 + x1) / 2;
    this.y = (y0 + y1) / 2;
    const wide = Math.max(x1 - x0, 1e-3), high = Math.max(y1 - y0, 1e-3);
    this.scale = 0.94 * Math.min(this.width / wide, this.height / high);
  }

  toScreen(x, y) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }

  toWorld(px, py) {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }

  // The place under the pixel stays there.
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const [x, y] = this.toWorld(px, py);
    this.scale = Math.min(1e5, Math.max(1e-4, this.scale * factor));
    this.x = x - (px - this.width / 2) / this.scale;
    this.y = y + (py - this.height / 2) / this.scale;
  }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }
}

// Mouse, wheel and fingers: drag moves, wheel and two fingers zoom, a click without a drag picks.
export function steerCamera(target, camera, {changed, picked}) {
  const fingers = new Map();
  let moved = 0, apart = 0;
  const place = event => {
    const box = target.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  };
  target.addEventListener('pointerdown', event => {
    target.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, place(event));
    moved = 0;
    if (fingers.size === 2) apart = spread();
  });
  target.addEventListener('pointermove', event => {
    const last = fingers.get(event.pointerId);
    if (!last) return;
    const now = place(event);
    const [dx, dy] = [now[0] - last[0], now[1] - last[1]];
    moved += Math.abs(dx) + Math.abs(dy);
    fingers.set(event.pointerId, now);
    if (moved < 4) return;
    camera.follows = false;
    camera.pan(dx / fingers.size, dy / fingers.size);
    if (fingers.size === 2) {
      const [a, b] = [...fingers.values()];
      camera.zoom(spread() / (apart || 1), (a[0] + b[0]) / 2, (a[1] + b[1]) / 2);
      apart = spread();
    }
    changed();
  });
  const release = event => {
    if (fingers.delete(event.pointerId) && fingers.size === 0 && moved < 4 && event.type === 'pointerup')
      picked(...place(event));
  };
  target.addEventListener('pointerup', release);
  target.addEventListener('pointercancel', release);
  target.addEventListener('wheel', event => {
    event.preventDefault();
    camera.zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), ...place(event));
    changed();
  }, {passive: false});
}
