// The window: buttons at the top, field, properties at the right, charts and the controls of the film at the bottom.
import {tableColour} from './colour_maps.js';
import {button, clockText, element, shortNumber} from './dom.js';
import {speeds} from './player.js';
import {quantities} from './quantities.js';
import {Film, savePng, saveSvg} from './save.js';

const keyList = [
  ['Space', 'play or pause'], ['← →', 'one frame back or on (Shift: ten)'], ['Home End', 'start or end'],
  ['↑ ↓', 'faster or slower'], ['L', 'largest load'], ['F', 'follow the platform'], ['0', 'show all'], ['+ −', 'zoom'],
  ['C', 'next colouring'], ['T', 'dark or light'], ['S', 'save the picture'], ['Esc', 'select nothing'],
];

export class Legend {
  constructor(view) {
    this.view = view;
    this.canvas = element('canvas', {className: 'legend', width: 480, height: 96});
  }

  // Draws the legend above the lower left corner of a picture of this height.
  draw(context, height) {
    const {quantity, range, colours, theme} = this.view;
    const [x, y, width] = [16, height - 34, 200];
    context.fillStyle = theme.legend;
    context.fillRect(x - 8, y - 26, width + 16, 56);
    for (let i = 0; i < width; ++i) {
      context.fillStyle = tableColour(colours, (quantity.reversed ? width - 1 - i : i) / (width - 1));
      context.fillRect(x + i, y, 1, 10);
    }
    context.fillStyle = theme.ink;
    context.font = '12px sans-serif';
    context.textAlign = 'left';
    context.fillText(quantity.label + (quantity.unit ? ` [${quantity.unit}]` : ''), x, y - 8);
    [0, 0.5, 1].forEach(share => {
      context.textAlign = ['left', 'center', 'right'][2 * share];
      context.fillText(shortNumber(range[0] + share * (range[1] - range[0]), 2), x + share * width, y + 23);
    });
  }
}

function colourChoice(view) {
  const select = element('select', {id: 'colour', title: 'colour of the floes (C)', on: {change: () => view.colourBy(select.value)}});
  view.colourSelect = select;
  for (const quantity of quantities) {
    const why = quantity.missing(view.run);
    select.append(element('option', {
      value: quantity.key, disabled: why !== '', title: why, textContent: quantity.label + (why ? ` (${why})` : ''),
    }));
  }
  return select;
}

function toggle(text, title, view, key, settings = {}) {
  const made = button(text, title, () => {
    view.options[key] = !view.options[key];
    made.setAttribute('aria-pressed', view.options[key]);
    view.draw();
  }, {'aria-pressed': view.options[key], ...settings});
  return made;
}

function topBar(view, live) {
  const {run} = view;
  const film = new Film(view);
  const filmButton = button('Film', Film.missing || 'records what is played, as WebM, until it is pressed again', () => {
    if (film.running) film.stop();
    else film.start();
    filmButton.setAttribute('aria-pressed', film.running);
    filmButton.textContent = film.running ? 'End film' : 'Film';
  }, {disabled: Film.missing !== '', id: 'film'});
  view.followButton = button('Follow', 'keep the platform in the middle (F)', () => view.follow(), {
    'aria-pressed': false, disabled: !view.run.description.platform.present});
  view.badge = element('span');
  return element('header', {}, [
    element('h1', {textContent: view.run.description.name}), view.badge, ...(live ? [live.box] : []),
    element('label', {}, ['Colour ', colourChoice(view)]),
    button('Largest load', 'go to the largest ice load (L)', () => view.showLargest(), {id: 'largest', className: 'main'}),
    button('Show all', 'the whole field (0)', () => view.fitAll()), view.followButton,
    toggle('Forces', 'arrows of the forces on the platform; floes that press', view, 'forces'),
    toggle('Chains', run.description.contacts_recorded ? 'forces between bodies, the wider the larger' :
      'forces between bodies: not recorded, run with --set output.contact_forces=true', view, 'chains',
    {disabled: !run.description.contacts_recorded, id: 'chains'}),
    toggle('Track', 'path of the platform in the last ten minutes', view, 'track'),
    button('PNG', 'save the picture (S)', () => savePng(view), {id: 'save_png'}),
    button('SVG', 'save the picture as a drawing', () => saveSvg(view), {id: 'save_svg'}), filmButton,
    button('◐', 'dark or light (T)', () => view.setTheme(view.themeName === 'dark' ? 'light' : 'dark'), {ariaLabel: 'dark or light'}),
    button('?', 'keys', () => view.help.showModal(), {ariaLabel: 'keys'}),
  ]);
}

function filmControls(view) {
  const {player} = view;
  const play = button('▶', 'play or pause (space)', () => player.play(), {id: 'play', ariaLabel: 'play or pause'});
  player.changed = () => play.textContent = player.playing ? '❚❚' : '▶';
  const speed = element('select', {id: 'speed', title: 'simulated over real time (↑ ↓)',
    on: {change: () => player.speed = Number(speed.value)}},
  speeds.map(value => element('option', {value, textContent: `${value}×`, selected: value === player.speed})));
  view.speedSelect = speed;
  const loop = button('⟳', 'begin again at the end', () => {
    player.loops = !player.loops;
    loop.setAttribute('aria-pressed', player.loops);
  }, {'aria-pressed': player.loops, ariaLabel: 'loop'});
  view.scrub = element('input', {type: 'range', id: 'scrub', min: 0, max: 1, step: 'any', value: 0, title: 'time',
    ariaLabel: 'time', on: {input: () => player.seek(Number(view.scrub.value))}});
  view.clock = element('output', {id: 'clock'});
  return element('footer', {}, [
    button('|‹', 'start (Home)', () => player.seek(0), {ariaLabel: 'start'}),
    button('‹', 'one frame back (←)', () => player.step(-1), {ariaLabel: 'one frame back'}), play,
    button('›', 'one frame on (→)', () => player.step(1), {ariaLabel: 'one frame on', id: 'step'}),
    button('›|', 'end (End)', () => player.seek(view.run.end), {ariaLabel: 'end'}), view.scrub, view.clock, speed, loop,
  ]);
}

function helpDialog() {
  const dialog = element('dialog', {}, [
    element('h2', {textContent: 'Keys'}),
    element('table', {}, keyList.map(([key, what]) => element('tr', {}, [
      element('th', {textContent: key}), element('td', {textContent: what})]))),
    element('p', {textContent: 'Drag or wheel moves and zooms the field. A click on a floe or the platform shows its ' +
      'properties. A click in a chart goes to that time; dragging there zooms, a double click returns.'}),
    button('Close', 'close', () => dialog.close()),
  ]);
  return dialog;
}

export function layOut(view, {side, charts, live}) {
  const {field, over} = view.canvases;
  view.help = helpDialog();
  view.stage = element('div', {className: 'stage', tabIndex: 0, ariaLabel: 'ice field'}, [field, over, view.caption]);
  document.body.append(
      topBar(view, live),
      element('main', {}, [
        element('div', {className: 'left'}, [view.stage, element('div', {className: 'charts'}, charts)]),
        element('aside', {}, side),
      ]),
      filmControls(view), view.help);
}

export function setKeys(view) {
  const {player} = view;
  const faster = by => {
    const at = Math.min(speeds.length - 1, Math.max(0, speeds.indexOf(player.speed) + by));
    player.speed = speeds[at];
    view.speedSelect.value = speeds[at];
  };
  const keys = {
    ' ': () => player.play(), ArrowLeft: e => player.step(e.shiftKey ? -10 : -1), ArrowRight: e => player.step(e.shiftKey ? 10 : 1),
    Home: () => player.seek(0), End: () => player.seek(view.run.end), ArrowUp: () => faster(1), ArrowDown: () => faster(-1),
    l: () => view.showLargest(), f: () => view.follow(), 0: () => view.fitAll(), '+': () => view.zoom(1.3), '-': () => view.zoom(1 / 1.3),
    c: () => view.nextColour(), t: () => view.setTheme(view.themeName === 'dark' ? 'light' : 'dark'), s: () => savePng(view),
    Escape: () => view.select(null), '?': () => view.help.showModal(),
  };
  addEventListener('keydown', event => {
    if (event.ctrlKey || event.altKey || event.metaKey || view.help.open || event.target.closest('input, select, tr')) return;
    if (event.key === ' ' && event.target.closest('button')) return;
    const act = keys[event.key] ?? keys[event.key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act(event);
  });
}

// The verdict of the run with its reasons, or its status if there is none.
export function showBadge(view) {
  const {verdict, status} = view.run.description;
  view.badge.className = `badge ${verdict.grade}`;
  view.badge.textContent = verdict.grade === 'not judged' ? status : verdict.grade;
  view.badge.title = ['verdict of the run', ...verdict.reasons].join('\n');
}

export const clockLine = (time, end) => `${clockText(time)} / ${clockText(end)}`;
