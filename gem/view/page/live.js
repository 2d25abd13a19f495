// Data from the server of gem: all packets of a file, or those of a run as it goes on.
import {button, clockText, element} from './dom.js';
import {openPacket} from './unpack.js';

const pause = milliseconds => new Promise(done => setTimeout(done, milliseconds));

// Paths are relative to the page, whose own path holds the token.
async function ask(path, settings) {
  const answer = await fetch(path, {cache: 'no-store', ...settings});
  if (answer.status === 503) return null;  // the run has no file yet
  if (!answer.ok) throw new Error(await answer.text());
  return answer;
}

export async function describedByServer(said) {
  for (;;) {
    const answer = await ask('description');
    if (answer) return answer.json();
    said('The run begins ...');
    await pause(500);
  }
}

async function packetFrom(path) {
  const answer = await ask(path);
  if (!answer || answer.status === 204) return null;
  return openPacket(new Uint8Array(await answer.arrayBuffer()));
}

// Asks for what is new until nothing comes; returns whether anything came.
export async function fetchNew(run) {
  let any = false;
  if (!run.shapes) run.add(await packetFrom('shapes'));
  for (const group of ['platform', 'events', 'stats']) {
    const packet = await packetFrom(`rows?group=${group}&first=${run.nextRow[group]}`);
    if (packet && packet.count > 0) run.add(packet), any = true;
  }
  for (;;) {
    const packet = await packetFrom(`frames?first=${run.frameCount}`);
    if (!packet || packet.count === 0) return any;
    run.add(packet);
    any = true;
  }
}

// The bar of a run that goes on: progress, pause, go on, stop.
export class LiveBar {
  constructor() {
    this.progress = element('progress', {max: 1, value: 0});
    this.text = element('span', {className: 'progress', role: 'status'});
    this.pause = button('Pause run', 'the run waits; its numbers do not change', () => this.send(this.paused ? 'go_on' : 'pause'));
    this.stop = button('Stop run', 'ends the run in order, as Ctrl-C does; it can be continued', () => this.send('stop'));
    this.pause.id = 'pause_run';
    this.stop.id = 'stop_run';
    this.box = element('span', {className: 'live'}, [this.progress, this.text, this.pause, this.stop]);
    this.paused = false;
  }

  async send(what) {
    await ask(what, {method: 'POST'});
    this.show(await (await ask('state')).json());
  }

  show({time_s, duration_s, paused, running, stopping, message}) {
    this.paused = paused;
    this.progress.value = duration_s > 0 ? time_s / duration_s : 1;
    const word = !running ? 'ended' : stopping ? 'stopping' : paused ? 'paused' : 'runs';
    this.text.textContent = `${word}: ${clockText(time_s)} of ${clockText(duration_s)}${message ? ` (${message})` : ''}`;
    this.pause.textContent = paused ? 'Go on' : 'Pause run';
    this.pause.disabled = this.stop.disabled = !running || stopping;
  }

  // Follows the run to its end.
  async follow(run, came) {
    for (let running = true; running;) {
      await pause(1000);
      try {
        const state = await (await ask('state')).json();
        this.show(state);
        running = state.running;
        const description = await ask('description');
        if (description) Object.assign(run.description, await description.json());
        if (await fetchNew(run) || !running) came();
        if (!running) await ask('has_all', {method: 'POST'});
      } catch (error) {
        this.text.textContent = 'the run no longer answers: ' + error.message;
        this.pause.disabled = this.stop.disabled = true;
        return;
      }
    }
  }
}
