// What floes can be coloured by: value of each floe, range, unit; or the reason why this file cannot show it.
import {forceOfFloes, strongForce} from './chains.js';

const seconds = 600;  // range of the time since the last hit

function percentile(values, share) {
  const sorted = Float64Array.from(values.filter(Number.isFinite)).sort();
  return sorted.length ? sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] : 1;
}

// Speeds in frames spread over the run, for a range that stays the same while it plays.
function sampled(run, value) {
  const out = [];
  for (const block of run.blocks) {
    const stride = Math.max(1, Math.floor(block.vx.length / 4000));
    for (let i = 0; i < block.vx.length; i += stride) if (block.there[i]) out.push(value(block, i));
  }
  return out;
}

const speedOf = (block, i) => Math.hypot(block.vx[i], block.vy[i]) * block.steps.speed_m_per_s;
const spinOf = (block, i) => Math.abs(block.omega[i]) * block.steps.spin_rad_per_s;
const current = run => Math.max(...run.description.drive.current_m_per_s.map(row => Math.hypot(...row)));
const noHits = run => run.column('events', 'time').length === 0 ? 'this file has no hits on the platform' : '';

export const quantities = [
  {
    key: 'speed', label: 'Speed', unit: 'm/s', map: 'viridis', missing: () => '',
    range: run => [0, Math.max(1.1 * current(run), percentile(sampled(run, speedOf), 0.98), 1e-3)],
    fill: (view, out) => {
      const {vx, vy} = view.pose;
      for (let i = 0; i < out.length; ++i) out[i] = Math.hypot(vx[i], vy[i]);
    },
  },
  {
    key: 'spin', label: 'Spin', unit: 'rad/s', map: 'blue_orange', missing: () => '',
    range: run => {
      const most = Math.max(percentile(sampled(run, spinOf), 0.98), 1e-4);
      return [-most, most];
    },
    fill: (view, out) => out.set(view.pose.omega),
  },
  {
    key: 'thickness', label: 'Thickness', unit: 'm', map: 'viridis', missing: () => '',
    range: run => {
      const values = run.shapes.thickness;
      const least = values.reduce((a, b) => Math.min(a, b), Infinity), most = values.reduce((a, b) => Math.max(a, b), 0);
      return least < most ? [least, most] : [0, Math.max(most, 1e-3) * 1.25];
    },
    fill: (view, out) => out.set(view.run.shapes.thickness),
  },
  {
    key: 'size', label: 'Size (root of area)', unit: 'm', map: 'viridis', missing: () => '',
    range: run => [0, Math.sqrt(run.shapes.area.reduce((a, b) => Math.max(a, b), 0)) || 1],
    fill: (view, out) => {
      for (let i = 0; i < out.length; ++i) out[i] = Math.sqrt(view.run.shapes.area[i]);
    },
  },
  {
    key: 'class', label: 'Ice class', unit: '', map: 'classes',
    missing: run => run.description.classes.length < 2 ? 'this run has one class of ice' : '',
    range: () => [0, 6],
    fill: (view, out) => out.set(view.run.shapes.class),
  },
  {
    key: 'platform_force', label: 'Force on the platform', unit: 'N', map: 'viridis', missing: noHits,
    range: (run, hits) => [0, Math.max(percentile(hits.force, 0.99), 1)],
    fill: (view, out) => {
      out.fill(NaN);
      for (const i of view.hits.during(view.time, view.time)) {
        const floe = view.hits.floe[i];
        if (floe >= 0 && floe < out.length) out[floe] = (out[floe] || 0) + view.hits.force[i];
      }
    },
  },
  {
    key: 'since_hit', label: 'Time since last hit', unit: 's', map: 'viridis', reversed: true, missing: noHits,
    range: () => [0, seconds],
    fill: (view, out) => {
      view.hits.lastTouch(view.time, out);
      for (let i = 0; i < out.length; ++i) out[i] = view.time - out[i];
    },
  },
  {
    key: 'overlap', label: 'Overlap', unit: 'm', map: 'viridis',
    missing: () => 'run files hold no overlap of each floe, only the largest of all (see the properties)',
  },
  {
    key: 'contact_force', label: 'Contact force', unit: 'N', map: 'viridis',
    missing: run => run.description.contacts_recorded ? '' : 'not recorded: run with --set output.contact_forces=true',
    range: run => [0, 2 * strongForce(run)],
    fill: (view, out) => forceOfFloes(view.run, view.run.contactsAt(view.time), out),
  },
];
