// Loads and motions over time, by uPlot. A line shows the time; a click goes there; dragging zooms, a double click returns.
import {clockText, element, shortNumber} from './dom.js';

const sizeOf = (x, y) => Float64Array.from(x, (value, i) => Math.hypot(value, y[i]));

// A unit in which the largest value has at most four digits before the point.
function scaled(columns, unit) {
  const most = columns.flatMap(c => [...[c.reduce((a, b) => Math.max(a, Math.abs(b) || 0), 0)]]).reduce((a, b) => Math.max(a, b), 0);
  const [size, prefix] = most >= 2e6 ? [1e6, 'M'] : most >= 2e3 ? [1e3, 'k'] : [1, ''];
  return {columns: columns.map(c => c.map(value => value / size)), unit: prefix + unit};
}

function loadData(run) {
  const get = name => run.column('platform', name);
  const ice = sizeOf(get('ice_force_mean_x'), get('ice_force_mean_y'));
  const mooring = sizeOf(get('mooring_force_x'), get('mooring_force_y'));
  const {columns, unit} = scaled([ice, mooring], 'N');
  return {columns, unit, names: ['ice load', run.description.platform.holder], colours: ['load', 'mooring']};
}

function motionData(run) {
  const get = name => run.column('platform', name);
  const [ax, ay] = run.description.platform.anchor_m;
  return {
    columns: [get('x').map(x => x - ax), get('y').map(y => y - ay)], unit: 'm', names: ['along x', 'along y'],
    colours: ['series_a', 'series_b'],
  };
}

// Distances between two times on an axis [s]
const timeSteps = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, ...[1, 2, 5, 10, 15, 30, 60, 120, 180, 360, 720, 1440, 2880].map(
    minutes => 60 * minutes)];

class Chart {
  constructor(title, read, view) {
    Object.assign(this, {title, read, view});
    this.cursor = element('div', {className: 'now'});
    this.box = element('div', {className: 'chart', ariaLabel: title});
  }

  options(data) {
    const ink = this.view.theme.ink, grid = {stroke: this.view.theme.grid, width: 1};
    const axis = {stroke: ink, grid, ticks: {...grid, size: 4}, gap: 3, font: '11px sans-serif'};
    const series = data.names.map((label, i) => ({
      label: `${label} [${data.unit}]`, stroke: this.view.theme[data.colours[i]], width: 1.2, points: {show: false},
      value: (_, value) => value == null ? '-' : shortNumber(value),
    }));
    return {
      width: Math.max(200, this.box.clientWidth), height: Math.max(60, this.box.clientHeight - 30),
      padding: [6, 26, 0, 0],  // room for half a time at the right end
      cursor: {sync: {key: 'gem'}, points: {size: 5}, drag: {x: true, y: false}},
      legend: {live: true},
      scales: {x: {time: false}},
      axes: [
        {...axis, size: 22, incrs: timeSteps, values: (_, times) => times.map(clockText)},
        {...axis, size: 56, values: (_, values) => values.map(value => String(Number(value.toPrecision(6))))},
      ],
      series: [{label: 'time', value: (_, time) => time == null ? '-' : clockText(time)}, ...series],
      hooks: {setScale: [() => requestAnimationFrame(() => this.showTime())]},
    };
  }

  refresh() {
    const time = this.view.run.column('platform', 'time');
    if (time.length === 0) {
      this.box.replaceChildren(element('p', {className: 'note', textContent: `${this.title}: this run has no platform.`}));
      return;
    }
    const data = this.read(this.view.run);
    this.plot?.destroy();
    this.box.replaceChildren();
    this.plot = new uPlot(this.options(data), [time, ...data.columns], this.box);
    this.plot.over.append(this.cursor);
    let down = 0;
    this.plot.over.addEventListener('mousedown', event => down = event.clientX);
    this.plot.over.addEventListener('click', event => {
      if (Math.abs(event.clientX - down) > 3) return;
      const left = event.clientX - this.plot.over.getBoundingClientRect().left;
      this.view.player.seek(this.plot.posToVal(left, 'x'));
    });
    this.showTime();
  }

  showTime() {
    if (!this.plot) return;
    const left = this.plot.valToPos(this.view.time, 'x');
    this.cursor.style.transform = `translateX(${left}px)`;
    this.cursor.hidden = !(left >= 0 && left <= this.plot.bbox.width / devicePixelRatio);
  }
}

export class Charts {
  constructor(view) {
    this.list = [new Chart('Ice load', loadData, view), new Chart('Motion', motionData, view)];
    this.boxes = this.list.map(chart => chart.box);
  }
  refresh() { this.list.forEach(chart => chart.refresh()); }
  showTime() { this.list.forEach(chart => chart.showTime()); }
}
