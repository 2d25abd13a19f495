// The forces on the platform at a time, for its arrows: each with its name, its colour in the theme and its vector [N].

// A tow, the thrust of a ship in transit with what holds it on its path, and the ground give back each hit in one time
// step: their force is as large as the hit.
const givesBackHits = holder => ['tow', 'thrust', 'ground'].includes(holder);

// Ice, what holds the platform, drag of water and wind. The ice is the mean over the last force_window_s, the others are
// means over a sample. Where the holder gives back no hits, their sum too, with the ice of the same sample.
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
    const moves = ['tow', 'thrust'].includes(holder);
    forces.push({name: moves ? `${holder} and hold` : holder, colour: moves ? 'thrust' : 'mooring', vector: held});
  }
  forces.push({name: 'drag', colour: 'track', vector: at('drag_force')});
  if (givesBackHits(holder)) return forces;
  const parts = [at('ice_force'), held, at('drag_force')];
  const total = [0, 1].map(axis => parts.reduce((sum, vector) => sum + vector[axis], 0));
  return [...forces, {name: 'total', colour: 'ink', vector: total}];
}

// The largest force of ice or of what holds the platform in the run, at least `ice` [N]. The force of a single hit is
// no measure for arrows.
export function largestForce(run, ice) {
  if (givesBackHits(run.description.platform.holder)) return ice;
  const x = run.column('platform', 'mooring_force_x'), y = run.column('platform', 'mooring_force_y');
  return x.reduce((most, value, i) => Math.max(most, Math.hypot(value, y[i]) || 0), ice);
}
