// The forces on the platform at a time, for its arrows: each with its name, its colour in the theme and its vector [N].

// Ice, what holds the platform, drag of water and wind, and their sum. The ice is the mean over the last force_window_s.
export function platformForces(run, time) {
  const {holder} = run.description.platform;
  const at = name => ['x', 'y'].map(axis => run.platformAt(`${name}_${axis}`, time) || 0);
  const held = at('mooring_force');
  const forces = [{name: 'ice', colour: 'load', vector: at('ice_force_mean')}];
  if (holder === 'thrusters') {
    const thrust = at('thrust');
    forces.push({name: 'thrusters', colour: 'thrust', vector: thrust},
                {name: 'mooring', colour: 'mooring', vector: held.map((force, axis) => force - thrust[axis])});
  } else {
    forces.push({name: holder, colour: ['tow', 'thrust'].includes(holder) ? 'thrust' : 'mooring', vector: held});
  }
  forces.push({name: 'drag', colour: 'track', vector: at('drag_force')});
  const total = [0, 1].map(axis => forces.reduce((sum, force) => sum + force.vector[axis], 0));
  return [...forces, {name: 'total', colour: 'ink', vector: total}];
}

// The largest force of ice or of what holds the platform in the run, at least `ice` [N]. A tow or the ground gives
// back each hit in one time step, so their largest force is no measure for arrows.
export function largestForce(run, ice) {
  if (['tow', 'ground'].includes(run.description.platform.holder)) return ice;
  const x = run.column('platform', 'mooring_force_x'), y = run.column('platform', 'mooring_force_y');
  return x.reduce((most, value, i) => Math.max(most, Math.hypot(value, y[i]) || 0), ice);
}
