// Starts the page: reads the data, lays out the window, and keeps what is shown in step with the time.
import {Camera, steerCamera} from './camera.js';
import {strongForce} from './chains.js';
import {Charts} from './charts.js';
import {colourTable} from './colour_maps.js';
import {element} from './dom.js';
import {FieldGl} from './field_gl.js';
import {HitList, LoadCard} from './hit_list.js';
import {loadCauses} from './load_causes.js';
import {Hits} from './hits.js';
import {clockLine, layOut, Legend, setKeys, showBadge} from './layout.js';
import {LiveBar, describedByServer, fetchAll} from './live.js';
import {Overlay} from './overlay.js';
import {largestForce} from './platform_forces.js';
import {Player} from './player.js';
import {Properties} from './properties.js';
import {quantities} from './quantities.js';
import {Pose, RunData} from './run_data.js';
import {SideChart} from './side_chart.js';
import {bytesOfBase64, openPacket} from './unpack.js';

const themes = {
  dark: {
    water: [0.06, 0.11, 0.17], without: [0.42, 0.48, 0.54], outline: [0.03, 0.05, 0.08], ink: '#e6ebf0', panel: '#18212b',
    fixed: '#3a4653', platform: '#3c4a58', track: '#f5d76e', mark: '#ff4fd8', load: '#ff9f43', mooring: '#5ab4ff', thrust: '#7bd88f',
    grid: '#2c3947', chain: '#ff4f5e', series_a: '#5ab4ff', series_b: '#f5d76e', legend: 'rgba(24, 33, 43, 0.85)',
  },
  light: {
    water: [0.80, 0.88, 0.93], without: [0.97, 0.98, 0.99], outline: [0.25, 0.31, 0.37], ink: '#1f2530', panel: '#ffffff',
    fixed: '#a5afb9', platform: '#dfe5ea', track: '#8a4b00', mark: '#c4008f', load: '#d35400', mooring: '#0b63b5', thrust: '#1d7a34',
    grid: '#e1e4e8', chain: '#b3001b', series_a: '#0b63b5', series_b: '#a05a00', legend: 'rgba(255, 255, 255, 0.85)',
  },
};

class View {
  constructor(run) {
    this.run = run;
    this.time = 0;
    this.selected = null;  // a floe, 'platform' or null
    this.causes = [];      // floes that made a load
    this.options = {forces: true, track: true, chains: run.description.contacts_recorded};
    this.camera = new Camera();
    this.pose = new Pose(run);
    this.hits = new Hits(run);
    this.largest = this.hits.largestLoad();
    this.player = new Player(run, time => this.show(time));
    this.shares = new Float32Array(run.shapes.floes);
    this.canvases = {field: element('canvas'), over: element('canvas', {className: 'over'})};
    this.caption = element('p', {className: 'caption', role: 'status'});
    this.legend = new Legend(this);
    this.overlay = new Overlay(this);
    this.themeName = matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark';
    this.strongForce = 1;   // between bodies: the widest line [N]
    this.largestForce = 1;  // on the platform in the whole run: the measure of arrows [N]
    this.framesDrawn = 0;
    this.started = false;
    this.pose.moveTo(0);
  }

  get theme() { return themes[this.themeName]; }

  start(live) {
    const goTo = (time, what) => this.goTo(time, what);
    this.properties = new Properties(this);
    this.card = new LoadCard(this, goTo);
    this.list = new HitList(this, goTo);
    this.sides = new SideChart(this);
    this.charts = new Charts(this);
    const sideSection = element('section', {}, [element('h2', {textContent: 'Load by side'}), this.sides.box]);
    layOut(this, {side: [this.card.box, this.properties.box, this.list.box, sideSection], charts: this.charts.boxes, live});
    this.field = new FieldGl(this.canvases.field, this.run.shapes);
    document.documentElement.dataset.theme = this.themeName;
    steerCamera(this.stage, this.camera, {
      changed: () => {
        this.followButton.setAttribute('aria-pressed', this.camera.follows);
        this.draw();
      },
      picked: (x, y) => this.select(this.bodyAt(x, y)),
    });
    setKeys(this);
    this.colourBy('speed');
    this.resize();
    this.fitAll();
    this.refresh();
    this.started = true;
    new ResizeObserver(() => this.resize()).observe(this.stage);
  }

  // After new data.
  refresh() {
    this.hits.refresh();
    this.largest = this.hits.largestLoad();
    this.largestForce = largestForce(this.run, this.largest?.force ?? 1);
    document.getElementById('largest').disabled = !this.largest;
    this.scrub.max = this.run.end;
    showBadge(this);
    this.strongForce = strongForce(this.run);
    this.range = this.quantity.range(this.run, this.hits);
    for (const part of [this.card, this.list, this.charts, this.sides]) part.refresh();
    this.show(this.time);
  }

  resize() {
    const {clientWidth, clientHeight} = this.stage, ratio = devicePixelRatio || 1;
    const {camera} = this;
    const changed = camera.width !== clientWidth || camera.height !== clientHeight;
    [camera.width, camera.height] = [Math.max(1, clientWidth), Math.max(1, clientHeight)];
    for (const canvas of Object.values(this.canvases)) {
      canvas.width = Math.round(camera.width * ratio);
      canvas.height = Math.round(camera.height * ratio);
    }
    if (changed && this.started) this.charts.refresh();
    this.draw();
  }

  fitAll() {
    this.camera.follows = false;
    this.followButton.setAttribute('aria-pressed', false);
    this.camera.fit(this.extent());
    this.draw();
  }

  extent() {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    const add = (x, y) => {
      box[0] = Math.min(box[0], x);
      box[1] = Math.min(box[1], y);
      box[2] = Math.max(box[2], x);
      box[3] = Math.max(box[3], y);
    };
    const {pose, run} = this;
    for (let i = 0; i < pose.there.length; ++i) {
      const r = Math.sqrt(run.shapes.area[i]);
      if (pose.there[i]) add(pose.x[i] - r, pose.y[i] - r), add(pose.x[i] + r, pose.y[i] + r);
    }
    const {platform} = run.description;
    if (platform.present) for (const [x, y] of platform.outline) add(platform.anchor_m[0] + x, platform.anchor_m[1] + y);
    return box[0] <= box[2] ? box : [-100, -100, 100, 100];
  }

  follow() {
    this.camera.follows = !this.camera.follows;
    if (this.camera.follows) this.camera.scale = Math.max(this.camera.scale, this.closeScale());
    this.followButton.setAttribute('aria-pressed', this.camera.follows);
    this.draw();
  }

  closeScale() {
    return Math.min(this.camera.width, this.camera.height) / (3.5 * this.run.description.platform.diameter_m);
  }

  zoom(factor) {
    this.camera.zoom(factor);
    this.draw();
  }

  show(time) {
    this.time = time;
    this.player.time = time;
    this.pose.moveTo(time);
    this.scrub.value = time;
    this.clock.textContent = clockLine(time, this.run.end);
    this.draw();
    this.charts.showTime();
    // tables are for people: ten times a second is enough
    const now = performance.now();
    if (this.player.playing && now - (this.tablesAt ?? 0) < 100) return;
    this.tablesAt = now;
    this.properties.refresh();
    this.sides.draw();
  }

  draw() {
    if (!this.field) return;
    const {camera, canvases} = this;
    if (camera.follows) {
      const {x, y} = this.overlay.platformPose();
      [camera.x, camera.y] = [x, y];
    }
    this.colourFloes();
    this.field.draw(camera, this.pose, this.shares, this.theme);
    const context = canvases.over.getContext('2d'), ratio = canvases.over.width / camera.width;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, camera.width, camera.height);
    this.overlay.draw(context);
    this.legend.draw(context, camera.height);
    ++this.framesDrawn;
  }

  colourFloes() {
    const {quantity, range, shares} = this;
    quantity.fill(this, shares);
    const [low, high] = range, flip = quantity.reversed;
    for (let i = 0; i < shares.length; ++i) {
      const share = Math.min(1, Math.max(0, (shares[i] - low) / (high - low)));
      shares[i] = flip ? 1 - share : share;
    }
  }

  colourBy(key) {
    this.quantity = quantities.find(quantity => quantity.key === key);
    this.range = this.quantity.range(this.run, this.hits);
    this.colours = colourTable(this.quantity.map);
    this.field?.setColours(this.colours);
    this.colourSelect.value = key;
    this.draw();
  }

  nextColour() {
    const usable = quantities.filter(quantity => quantity.missing(this.run) === '');
    this.colourBy(usable[(usable.indexOf(this.quantity) + 1) % usable.length].key);
  }

  setTheme(name) {
    this.themeName = name;
    document.documentElement.dataset.theme = name;
    this.charts.refresh();
    this.sides.draw();
    this.draw();
  }

  // The floe under a pixel, 'platform', or null.
  bodyAt(px, py) {
    const [x, y] = this.camera.toWorld(px, py);
    const inside = (outline, bx, by, c, s) => {
      const u = c * (x - bx) + s * (y - by), v = -s * (x - bx) + c * (y - by);
      return outline.every(([ax, ay], k) => {
        const [ex, ey] = outline[(k + 1) % outline.length];
        return (ex - ax) * (v - ay) - (ey - ay) * (u - ax) >= 0;
      });
    };
    const {platform} = this.run.description;
    const at = this.overlay.platformPose();
    if (platform.present && platform.pieces.some(piece => inside(piece, at.x, at.y, at.cosine, at.sine))) return 'platform';
    const {pose, run} = this, {start, xy, area} = run.shapes;
    for (let i = 0; i < pose.there.length; ++i) {
      if (!pose.there[i] || Math.hypot(x - pose.x[i], y - pose.y[i]) > 4 * Math.sqrt(area[i])) continue;
      const outline = [];
      for (let k = start[i]; k < start[i + 1]; ++k) outline.push([xy[2 * k], xy[2 * k + 1]]);
      if (inside(outline, pose.x[i], pose.y[i], pose.cosine[i], pose.sine[i])) return i;
    }
    return null;
  }

  select(what) {
    this.selected = what;
    this.causes = [];
    this.caption.textContent = '';
    this.properties.refresh();
    this.draw();
  }

  // To a time, with a floe selected or the causes of the load at that time marked.
  goTo(time, what) {
    this.player.play(false);
    this.select(what === 'causes' ? 'platform' : what);
    if (what === 'causes') {
      const {floes, lying} = loadCauses(this.run, this.hits, time);
      this.causes = floes;
      this.caption.textContent = 'Largest ice load. Thick outlines: ' +
          (lying.length ? 'floes that lay at the platform.' : 'floes with 5 % of it or more.');
    }
    this.camera.follows = true;
    this.camera.scale = this.closeScale();
    this.followButton.setAttribute('aria-pressed', true);
    this.player.seek(time);
  }

  showLargest() {
    if (this.largest) this.goTo(this.largest.time, 'causes');
  }
}

async function addEmbedded(run, text) {
  run.add(await openPacket(bytesOfBase64(text.textContent)));
  text.remove();
}

const packetTexts = () => [...document.querySelectorAll('script[type="text/base64"]')];

const wholePageRead = () => new Promise(done => {
  if (document.readyState !== 'loading') done();
  else document.addEventListener('DOMContentLoaded', done);
});

// The script stands behind the first packets: shapes, two frames, rows. It shows them while the others are read.
async function startFile() {
  const run = new RunData(JSON.parse(document.querySelector('script[type="application/json"]').textContent));
  for (const text of packetTexts()) await addEmbedded(run, text);
  const view = new View(run);
  view.start(null);
  performance.mark('first_picture');
  await wholePageRead();
  for (const text of packetTexts()) {
    await new Promise(done => setTimeout(done));
    await addEmbedded(run, text);
    view.scrub.max = run.end;
  }
  view.refresh();
  return view;
}

async function startServed(kind, said) {
  const run = new RunData(await describedByServer(said));
  document.title = `${run.description.name} - gem view`;
  await fetchAll(run, said);
  const live = kind === 'live' ? new LiveBar() : null;
  const view = new View(run);
  view.start(live);
  performance.mark('first_picture');
  if (live) {
    let end = run.end;
    live.follow(run, () => {
      const atEnd = view.time >= end - 1e-6;  // who looks at the newest frame goes on looking at it
      end = run.end;
      if (atEnd && !view.player.playing) view.time = end;
      view.refresh();
    });
    view.player.seek(run.end);
  }
  return view;
}

async function startPage() {
  const notice = element('p', {className: 'notice', textContent: 'Reading the run ...', role: 'status'});
  document.body.append(notice);
  const said = text => notice.textContent = text;
  try {
    if (typeof DecompressionStream === 'undefined') throw new Error('this browser is too old: it cannot unpack the data');
    const served = document.querySelector('script[type="text/server"]');
    const view = await (served ? startServed(served.textContent.trim(), said) : startFile());
    window.gemView = view;  // for tests and the curious
    performance.mark('all_read');
    notice.remove();
  } catch (error) {
    said(`The run cannot be shown: ${error.message}`);
    console.error(error);
  }
}

startPage();
