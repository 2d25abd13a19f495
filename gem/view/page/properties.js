// Properties of what is selected: the platform, a floe, or the run.
import {clockText, element, shortNumber, withUnit} from './dom.js';

const degrees = 180 / Math.PI;

const velocityText = ([x, y]) => `${shortNumber(Math.hypot(x, y))} m/s` +
    (x || y ? `, to ${Math.round(Math.atan2(y, x) * degrees)}° from +x` : '');

// A hull is long, or as wide as it is long.
function hullRow(platform) {
  const [length, width] = [0, 1].map(axis => {
    const values = platform.outline.map(corner => corner[axis]);
    return Math.max(...values) - Math.min(...values);
  });
  return Math.abs(length - width) < 0.03 * length ? ['Diameter', `${shortNumber(platform.diameter_m)} m`] :
      ['Length × width', `${shortNumber(length)} × ${shortNumber(width)} m`];
}

function runRows(view) {
  const {run, time} = view, {description} = run, {origin, rounding} = description;
  const frame = run.frameTimes.length;
  const rows = [
    ['Run', description.name], ['Status', description.status], ['Verdict', description.verdict.grade],
    ['Floes', `${description.floes}`], ['Simulated', clockText(run.end)],
    ...['current', 'wind'].filter(name => run.driveAt(name, time)).map(
        name => [name === 'wind' ? 'Wind' : 'Current', velocityText(run.driveAt(name, time))]),
    ['Hits on the platform', `${view.hits.count}`],
    ['Engine', `${origin.gem_engine}, ${origin.gem_solver}`], ['Seed', origin.gem_seed],
    ['State hash', origin.gem_state_hash || '-'], ['Program', origin.source],
    ['Frames', frame + (description.frame_stride > 1 ? ` (every ${description.frame_stride}th of the file)` : '')],
    ['Rounded to', `${shortNumber(1000 * rounding.place_m, 2)} mm, ${shortNumber(1000 * rounding.speed_m_per_s, 2)} mm/s`],
  ];
  const overlap = run.column('stats', 'maximum_overlap');
  if (overlap.length) rows.push(['Largest overlap', `${shortNumber(1000 * overlap.reduce((a, b) => Math.max(a, b), 0))} mm`]);
  return rows;
}

const forceOf = {mooring: 'Mooring force', thrusters: 'Force of thrusters', tow: 'Force of tow and hold', thrust: 'Net thrust and hold', ground: 'Force of the ground'};

function platformRows(view) {
  const {run, time} = view, {platform} = run.description;
  const at = name => run.platformAt(name, time);
  const size = name => Math.hypot(at(`${name}_x`), at(`${name}_y`));
  return [
    ['Ice load', withUnit(size('ice_force_mean'), 'N')], [forceOf[platform.holder], withUnit(size('mooring_force'), 'N')],
    ['Offset x', `${shortNumber(at('x') - platform.anchor_m[0])} m`],
    ['Offset y', `${shortNumber(at('y') - platform.anchor_m[1])} m`], ['Yaw', `${shortNumber(at('psi') * degrees)}°`],
    ['Speed', `${shortNumber(Math.hypot(at('vx'), at('vy')))} m/s`],
    ['Ice yaw moment', withUnit(at('ice_yaw_moment'), 'N m')], ['Contacts', `${Math.round(at('contacts'))}`],
    ['Floes pressing', `${view.hits.during(time, time).length}`], hullRow(platform),
    ['Mass', `${shortNumber(platform.mass_kg / 1000)} t`],
    ['Stiffness', `${withUnit(platform.stiffness_N_per_m, 'N/m')}`],
    ['Natural period', platform.natural_period_s > 0 ? `${shortNumber(platform.natural_period_s)} s` : '-'],
  ];
}

function floeRows(view, i) {
  const {run, pose, hits} = view, {shapes} = run;
  const own = [];
  for (let k = 0; k < hits.count; ++k) if (hits.floe[k] === i) own.push(k);
  const impulse = own.reduce((sum, k) => sum + (hits.impulse[k] || 0), 0);
  const rows = [
    ['Floe', `${i}`], ['Ice class', run.description.classes[shapes.class[i]] ?? '-'],
    ['Thickness', `${shortNumber(shapes.thickness[i])} m`], ['Size', `${shortNumber(Math.sqrt(shapes.area[i]))} m`],
    ['Area', `${shortNumber(shapes.area[i])} m²`], ['Mass', `${shortNumber(shapes.mass[i] / 1000)} t`],
  ];
  if (!pose.there[i]) rows.push(['Now', 'retired: it left the field']);
  else rows.push(
      ['x, y', `${shortNumber(pose.x[i], 5)}, ${shortNumber(pose.y[i], 5)} m`],
      ['Speed', `${shortNumber(Math.hypot(pose.vx[i], pose.vy[i]))} m/s`],
      ['Spin', `${shortNumber(pose.omega[i] * degrees)} °/s`]);
  rows.push(['Hits on the platform', `${own.length}`]);
  if (own.length) rows.push(
      ['Impulse of all hits', withUnit(impulse, 'N s')],
      ['First hit', clockText(own.reduce((least, k) => Math.min(least, hits.time[k]), Infinity))]);
  return rows;
}

export class Properties {
  constructor(view) {
    this.view = view;
    this.title = element('h2', {textContent: 'Properties'});
    this.table = element('table', {className: 'properties'});
    this.box = element('section', {}, [this.title, this.table]);
  }

  refresh() {
    const {view} = this, {selected} = view;
    const floe = Number.isInteger(selected);
    this.title.textContent = floe ? 'Selected floe' : selected === 'platform' ? 'Platform' : 'Run';
    const rows = floe ? floeRows(view, selected) : selected === 'platform' ? platformRows(view) : runRows(view);
    const texts = JSON.stringify(rows);
    if (texts === this.texts) return;
    this.texts = texts;
    this.table.replaceChildren(...rows.map(([name, value]) => element('tr', {}, [
      element('th', {textContent: name, scope: 'row'}), element('td', {textContent: value}),
    ])));
  }
}
