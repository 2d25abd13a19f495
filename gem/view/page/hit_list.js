// The largest load with its causes, and the hits on the platform, largest first. A click goes there.
import {button, clockText, element, shortNumber, withUnit} from './dom.js';

const shown = 60;
const orders = [
  {key: 'force', label: 'mean force', text: value => withUnit(value, 'N')},
  {key: 'impulse', label: 'impulse', text: value => withUnit(value, 'N s')},
  {key: 'closing', label: 'closing speed', text: value => `${shortNumber(value)} m/s`},
  {key: 'peak', label: 'crushing peak', text: value => withUnit(value, 'N')},
];

export class LoadCard {
  constructor(view, goTo) {
    Object.assign(this, {view, goTo});
    this.box = element('section', {className: 'card'});
  }

  refresh() {
    const {view} = this, {largest} = view;
    if (!largest) {
      this.box.replaceChildren(element('h2', {textContent: 'Largest ice load'}),
          element('p', {className: 'note', textContent: 'None: no ice has pressed on a platform in this file.'}));
      return;
    }
    const window = view.run.description.force_window_s;
    const causes = view.hits.causes(largest.time);
    const last = causes.reduce((late, one) => late && view.hits.time[late.hit] >= view.hits.time[one.hit] ? late : one, null);
    const say = !last ? 'No listed hit pressed then: slow contacts alone made it.' :
        `${causes.length} ${causes.length === 1 ? 'floe' : 'floes'} pressed. The last to come was floe ` +
            `${view.hits.floe[last.hit]}, ${shortNumber(largest.time - view.hits.time[last.hit], 2)} s before. ` +
            `All hits together: ${Math.round(100 * causes.reduce((sum, one) => sum + one.share, 0))} % of the load, ` +
            'slow contacts and friction the rest' +
            `${view.hits.windowImpulse.length ? '' : ', estimated by the mean force of each hit'}; the largest:`;
    const list = causes.slice(0, 3).map(({hit, share, impulse}) => element('li', {}, [
      button(`floe ${view.hits.floe[hit]}`, 'show this floe', () => this.goTo(largest.time, view.hits.floe[hit])),
      ` ${Math.round(100 * share)} %, ${withUnit(impulse / window, 'N')}, hit at ` +
          `${clockText(view.hits.time[hit])} with ${shortNumber(view.hits.closing[hit])} m/s`,
    ]));
    this.box.replaceChildren(
        element('h2', {textContent: 'Largest ice load'}),
        element('p', {className: 'headline'}, [
          element('strong', {textContent: withUnit(largest.force, 'N')}),
          ` at ${clockText(largest.time)} (mean of ${window} s) `,
          button('Show it', 'go to the largest load (L)', () => this.goTo(largest.time, 'causes'), {id: 'show_largest'}),
        ]),
        element('p', {className: 'note', textContent: say}), element('ul', {}, list));
  }
}

export class HitList {
  constructor(view, goTo) {
    Object.assign(this, {view, goTo});
    this.order = orders[0];
    this.select = element('select', {
      title: 'order of the hits', on: {change: () => {
        this.order = orders.find(order => order.key === this.select.value);
        this.refresh();
      }},
    }, orders.map(({key, label}) => element('option', {value: key, textContent: label})));
    this.body = element('tbody');
    this.note = element('p', {className: 'note'});
    this.head = element('th');
    this.box = element('section', {className: 'hits'}, [
      element('h2', {}, ['Hits, largest ', this.select]), this.note,
      element('table', {id: 'hits'}, [
        element('thead', {}, [element('tr', {}, [
          element('th', {textContent: 'time'}), element('th', {textContent: 'floe'}), this.head,
          element('th', {textContent: 'lasts'}),
        ])]), this.body,
      ]),
    ]);
  }

  refresh() {
    const {hits} = this.view, {order} = this;
    this.head.textContent = order.label;
    this.note.textContent = hits.count === 0 ? 'No hits on the platform in this file.' :
        `${Math.min(shown, hits.count)} of ${hits.count}. A click shows it.`;
    this.body.replaceChildren(...hits.largest(hits[order.key], shown).map(i => this.row(i)));
  }

  row(i) {
    const {hits} = this.view;
    const go = () => this.goTo(hits.time[i] + hits.lasts(i) / 2, hits.floe[i]);
    return element('tr', {tabIndex: 0, on: {click: go, keydown: event => event.key === 'Enter' && go()}},
        [clockText(hits.time[i]), String(hits.floe[i]), this.order.text(hits[this.order.key][i]),
          `${shortNumber(hits.lasts(i), 2)} s`].map(text => element('td', {textContent: text})));
  }
}
