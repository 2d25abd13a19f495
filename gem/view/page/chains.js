// The forces between bodies of each frame, and how they are drawn: a line from centroid to centroid over the point of
// contact, as wide as the force is large.

const narrowest = 0.6, widest = 9;  // pixels

// Of each frame: bodies a and b, point about the centroid of b [m], force on b [N].
export function readContacts(packet) {
  const {numbers} = packet, frames = [];
  for (let n = 0; n < packet.count; ++n) {
    const count = numbers.whole(), step = packet.force_N[n];
    const frame = {a: new Int32Array(count), b: new Int32Array(count), x: new Float32Array(count), y: new Float32Array(count),
      fx: new Float32Array(count), fy: new Float32Array(count), force: new Float32Array(count)};
    for (let i = 0, a = 0; i < count; ++i) {
      a += numbers.whole();
      frame.a[i] = a;
      frame.b[i] = a + numbers.whole();
      frame.x[i] = numbers.signed() * packet.place_m;
      frame.y[i] = numbers.signed() * packet.place_m;
      frame.fx[i] = numbers.signed() * step;
      frame.fy[i] = numbers.signed() * step;
      frame.force[i] = Math.hypot(frame.fx[i], frame.fy[i]);
    }
    frames.push(frame);
  }
  return frames;
}

// The sum of the forces on each floe, without regard to their direction [N].
export function forceOfFloes(run, frame, out) {
  out.fill(0);
  if (!frame) return;
  const first = run.description.first_floe_body;
  const add = (body, force) => {
    const floe = body - first;
    if (floe >= 0 && floe < out.length) out[floe] += force;
  };
  for (let i = 0; i < frame.a.length; ++i) {
    add(frame.a[i], frame.force[i]);
    add(frame.b[i], frame.force[i]);
  }
}

// A force that few forces of the run exceed: the widest line [N].
export function strongForce(run) {
  const all = [];
  for (const frame of run.contacts) {
    const stride = Math.max(1, Math.floor(frame.force.length / 200));
    for (let i = 0; i < frame.force.length; i += stride) all.push(frame.force[i]);
  }
  all.sort((a, b) => a - b);
  return all.length ? Math.max(all[Math.floor(0.98 * (all.length - 1))], 1) : 1;
}

// Calls line(points, width) with the points in metres of each force of the frame that is shown.
export function eachChain(view, line) {
  const {run, pose} = view, frame = run.contactsAt(view.time);
  if (!frame) return;
  const first = run.description.first_floe_body, most = view.strongForce;
  const platform = view.overlay.platformPose();
  const centre = body => {
    const floe = body - first;
    if (floe >= 0) return floe < pose.there.length && pose.there[floe] ? [pose.x[floe], pose.y[floe]] : null;
    return body === 0 && run.description.platform.present ? [platform.x, platform.y] : null;
  };
  for (let i = 0; i < frame.a.length; ++i) {
    const width = widest * Math.sqrt(Math.min(1, frame.force[i] / most));
    if (width < narrowest) continue;
    const b = centre(frame.b[i]), a = centre(frame.a[i]);
    const base = frame.b[i] >= first ? b : [0, 0];
    if (!base) continue;
    const point = [base[0] + frame.x[i], base[1] + frame.y[i]];
    line([a, point, b].filter(Boolean), width);
  }
}
