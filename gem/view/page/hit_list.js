// The largest load with its causes, and the hits on the platform, largest first. A click goes there.
import {button, clockText, element, shortNumber, withUnit} from './dom.js';
import {leastShare, loadCauses} from './load_causes.js';

const shown = 60;
const orders = [
  {key: 'force', label: 'mean force', text: value => withUnit(value, 'N')},
  {key: 'impulse', label: 'impulse', text: value => withUnit(value, 'N s')},
  {key: 'closing', label: 'closing speed', text: value => `${shortNumber(value)} m/s`},
  {key: 'peak', label: 'peak force', text: value => withUnit(value, 'N')},
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
    const {hits, run} = view, window = run.description.force_window_s;
    const causes = loadCauses(run, hits, largest.time);
    const listed = causes.lying.length ? causes.hits.filter(one => one.share >= leastShare) : causes.hits;
    const list = listed.slice(0, 3).map(({hit, share, impulse}) => this.item(hits.floe[hit],
        `${Math.round(100 * share)} %, ${withUnit(impulse / window, 'N')}, hit at ` +
            `${clockText(hits.time[hit])} with ${shortNumber(hits.closing[hit])} m/s`));
    for (const floe of causes.lying.slice(0, 3))
      list.push(this.item(floe, `${shortNumber(run.shapes.area[floe], 2)} m², lay at the platform`));
    this.box.replaceChildren(
        element('h2', {textContent: 'Largest ice load'}),
        element('p', {className: 'headline'}, [
          element('strong', {textContent: withUnit(largest.force, 'N')}),
          ` at ${clockText(largest.time)} (mean of ${window} s) `,
          button('Show it', 'go to the largest load (L)', () => this.goTo(largest.time, 'causes'), {id: 'show_largest'}),
        ]),
        element('p', {className: 'note', textContent: this.text(causes)}), element('ul', {}, list));
  }

  item(floe, text) {
    return element('li', {}, [button(`floe ${floe}`, 'show this floe', () => this.goTo(this.view.largest.time, floe)), ` ${text}`]);
  }

  // What made the load, in words.
  text({hits: list, explained, lying}) {
    const {hits, largest, run} = this.view;
    const many = (count, one) => `${count} ${one}${count === 1 ? '' : 's'}`;
    const guess = hits.windowImpulse.length ? '' : ', estimated by the mean force of each hit';
    if (lying.length) return `The ice that lay at the platform pressed: ${many(lying.length, 'floe')} on that side. Which of them ` +
        `carried how much is not recorded${run.description.contacts_recorded ? '' : ' (output.contact_forces does)'}. New hits made ${Math.max(0, Math.round(100 * explained))} %${guess}. The largest:`;
    if (!list.length) return 'No listed hit pressed then: slow contacts alone made it.';
    const rest = `their hits made ${Math.round(100 * explained)} % of the load${guess}, slow contacts and friction the rest:`;
    const [{hit, share}] = list, all = `${many(list.length, 'floe')} pressed;`;
    if (share < 0.3) return `${all} ${rest}`;
    return `Mainly floe ${hits.floe[hit]}: it hit ${shortNumber(largest.time - hits.time[hit], 2)} s before, with ` +
        `${shortNumber(hits.closing[hit])} m/s. ${list.length > 1 ? 'In all ' : ''}${all} ${rest}`;
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
