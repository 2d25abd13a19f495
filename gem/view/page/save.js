// Saves the picture as PNG or SVG, and what is played as a film (WebM).
import {eachChain} from './chains.js';
import {dashOf, linesNow} from './lines.js';
import {tableColour} from './colour_maps.js';

export function offer(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

const fileName = view => `${view.run.description.name.replace(/[^\w.-]+/g, '_') || 'run'}_${Math.round(view.time)}s`;

// Field, overlay and legend in one canvas.
export function composed(view, canvas = document.createElement('canvas')) {
  const {field, over} = view.canvases;
  if (canvas.width !== field.width || canvas.height !== field.height) {
    canvas.width = field.width;
    canvas.height = field.height;
  }
  const context = canvas.getContext('2d');
  view.draw();  // a WebGL canvas can be read only just after it was drawn
  context.drawImage(field, 0, 0);
  context.drawImage(over, 0, 0);
  const ratio = field.width / view.camera.width;
  context.save();
  context.scale(ratio, ratio);
  view.legend.draw(context, view.camera.height);
  context.restore();
  return canvas;
}

export function savePng(view) {
  composed(view).toBlob(blob => offer(blob, `${fileName(view)}.png`), 'image/png');
}

const escapes = {'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;', '\'': '&#39;'};
const escapedText = text => String(text).replace(/[&<>"']/g, sign => escapes[sign]);
const hexColour = rgb => '#' + rgb.map(c => Math.round(255 * c).toString(16).padStart(2, '0')).join('');

// A drawing in metres: one polygon for each floe.
export function svgText(view) {
  const {run, pose, camera, shares, colours, theme} = view, {start, xy} = run.shapes;
  const point = (x, y) => camera.toScreen(x, y).map(v => v.toFixed(2)).join(',');
  const polygon = (points, fill, more = '') => `<polygon points="${points}" fill="${fill}"${more}/>`;
  const turned = (outline, x, y, c, s) => outline.map(([a, b]) => point(x + c * a - s * b, y + s * a + c * b)).join(' ');
  const parts = [];
  for (let i = 0; i < run.shapes.floes; ++i) {
    if (!pose.there[i]) continue;
    const outline = [];
    for (let k = start[i]; k < start[i + 1]; ++k) outline.push([xy[2 * k], xy[2 * k + 1]]);
    const fill = Number.isFinite(shares[i]) ? tableColour(colours, shares[i]) : hexColour(theme.without);
    parts.push(polygon(turned(outline, pose.x[i], pose.y[i], pose.cosine[i], pose.sine[i]), fill));
  }
  const chains = [];
  if (view.options.chains) eachChain(view, (points, width) => chains.push(
      `<polyline points="${points.map(([px, py]) => point(px, py)).join(' ')}" stroke-width="${width.toFixed(2)}"/>`));
  const lines = linesNow(view).map(({from, to, width, state}) =>
      `<polyline points="${point(...from)} ${point(...to)}" stroke="${state === 'broken' ? theme.chain : theme.mooring}" ` +
      `stroke-width="${width.toFixed(2)}" stroke-dasharray="${dashOf(state).join(' ') || 'none'}"/>`);
  const fixed = run.description.fixed.map(outline => polygon(turned(outline, 0, 0, 1, 0), theme.fixed));
  const {x, y, cosine, sine} = view.overlay.platformPose();
  const platform = run.description.platform.present ?
      run.description.platform.pieces.map(piece =>
          polygon(turned(piece, x, y, cosine, sine), theme.platform, ` stroke="${theme.ink}"`)).join('') : '';
  const title = `${run.description.name}, ${view.time.toFixed(1)} s, coloured by ${view.quantity.label}`;
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${camera.width} ${camera.height}">` +
      `<title>${escapedText(title)}</title><rect width="100%" height="100%" fill="${hexColour(theme.water)}"/>` +
      `<g stroke="${hexColour(theme.outline)}" stroke-width="0.5">${parts.join('')}</g>${fixed.join('')}` +
      `<g stroke="${theme.chain}" fill="none" stroke-linecap="round">${chains.join('')}</g>${lines.join('')}${platform}</svg>\n`;
}

export function saveSvg(view) {
  offer(new Blob([svgText(view)], {type: 'image/svg+xml'}), `${fileName(view)}.svg`);
}

// Records what is shown until it is stopped.
export class Film {
  constructor(view) {
    this.view = view;
    this.recorder = null;
    this.canvas = document.createElement('canvas');
  }

  get running() { return this.recorder !== null; }

  static get missing() {
    return typeof MediaRecorder === 'undefined' || !MediaRecorder.isTypeSupported('video/webm') ?
        'this browser cannot record WebM' : '';
  }

  start() {
    composed(this.view, this.canvas);
    const parts = [];
    this.recorder = new MediaRecorder(this.canvas.captureStream(30), {mimeType: 'video/webm', videoBitsPerSecond: 8e6});
    this.recorder.ondataavailable = event => parts.push(event.data);
    this.recorder.onstop = () => offer(new Blob(parts, {type: 'video/webm'}), `${fileName(this.view)}.webm`);
    this.recorder.start();
    const grab = () => {
      if (!this.recorder) return;
      composed(this.view, this.canvas);
      requestAnimationFrame(grab);
    };
    grab();
  }

  stop() {
    this.recorder?.stop();
    this.recorder = null;
  }
}
