// Data from the server of gem: all packets of a file, or those of a run as it goes on.
import {button, clockText, element} from './dom.js';
import {openPacket} from './unpack.js';

const pause = milliseconds => new Promise(done => setTimeout(done, milliseconds));
const mostFailures = 60;  // in a row, one a second: then nobody is there any more

// Says whether it is worth to ask again: the run has no file yet, or the server does not answer.
class Unanswered extends Error {
  constructor(message, waits) {
    super(message);
    this.waits = waits;  // for the run: that may take long
  }
}

// Paths are relative to the page, whose own path holds the token.
async function ask(path, settings) {
  let answer;
  try {
    answer = await fetch(path, {cache: 'no-store', ...settings});
  } catch (error) {
    throw new Unanswered(error.message, false);
  }
  if (answer.status === 503) throw new Unanswered(await answer.text(), true);
  if (!answer.ok) throw new Error(await answer.text());
  return answer;
}

// What an action gives, which is done again while nobody answers.
async function insist(action, said) {
  for (let failures = 0; ;) {
    try {
      return await action();
    } catch (error) {
      if (!(error instanceof Unanswered)) throw error;
      if (!error.waits && ++failures > mostFailures) throw error;
      said(error.waits ? 'The run begins ...' : `No answer (${error.message}), asking again ...`);
      await pause(error.waits ? 500 : 1000);
    }
  }
}

export const describedByServer = said => insist(async () => (await ask('description')).json(), said);

async function packetFrom(path) {
  const answer = await ask(path);
  return answer.status === 204 ? null : openPacket(new Uint8Array(await answer.arrayBuffer()));
}

// All that the file holds now.
export const fetchAll = (run, said) => insist(() => fetchNew(run), said);

// Asks for what is new until nothing comes; returns whether anything came. May be done again after a failure.
async function fetchNew(run) {
  let any = false;
  if (!run.shapes) run.add(await packetFrom('shapes'));
  for (const group of ['platform', 'events', 'stats']) {
    const packet = await packetFrom(`rows?group=${group}&first=${run.nextRow[group]}`);
    if (packet && packet.count > 0) run.add(packet), any = true;
  }
  const take = async path => {
    const packet = await packetFrom(path);
    if (!packet || packet.count === 0) return false;
    run.add(packet);
    return any = true;
  };
  while (await take(`frames?first=${run.frameCount}`));
  if (run.description.contacts_recorded) while (await take(`contacts?first=${run.contacts.length}`));
  return any;
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
    try {
      await ask(what, {method: 'POST'});
      this.show(await (await ask('state')).json());
    } catch (error) {
      this.text.textContent = `not done (${error.message}): try again`;
    }
  }

  show({time_s, duration_s, paused, running, stopping, message}) {
    this.paused = paused;
    this.progress.value = duration_s > 0 ? time_s / duration_s : 1;
    const word = !running ? 'ended' : stopping ? 'stopping' : paused ? 'paused' : 'runs';
    this.text.textContent = `${word}: ${clockText(time_s)} of ${clockText(duration_s)}${message ? ` (${message})` : ''}`;
    this.pause.textContent = paused ? 'Go on' : 'Pause run';
    this.pause.disabled = this.stop.disabled = !running || stopping;
  }

  // Follows the run to its end. The server sets the pace: a browser slows down the clock of a page in a hidden tab.
  async follow(run, came) {
    addEventListener('pagehide', () => navigator.sendBeacon('leave'));
    for (let failures = 0; ;) {
      try {
        if (await this.lookOnce(run, came)) return;
        failures = 0;
      } catch (error) {
        const again = error instanceof Unanswered && ++failures <= mostFailures;
        this.text.textContent = again ? `no answer (${error.message}), asking again` : `the run no longer answers: ${error.message}`;
        if (!again) break;
        await pause(1000);
      }
    }
    this.pause.disabled = this.stop.disabled = true;
  }

  // Takes what is new; returns whether the run is over and all of it was read.
  async lookOnce(run, came) {
    const state = await (await ask('wait')).json();
    this.show(state);
    Object.assign(run.description, await (await ask('description')).json());
    if (await fetchNew(run) || !state.running) came();
    if (!state.running) await ask('has_all', {method: 'POST'});
    return !state.running;
  }
}
