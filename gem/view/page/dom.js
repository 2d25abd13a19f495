// Elements of the page, and numbers as people read them. Texts become text nodes, never HTML.

export function element(tag, settings = {}, children = []) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(settings)) {
    if (name === 'on') for (const [event, act] of Object.entries(value)) made.addEventListener(event, act);
    else if (name in made) made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

export const button = (text, title, act, settings = {}) =>
    element('button', {type: 'button', textContent: text, title, on: {click: act}, ...settings});

// Three significant digits without an exponent where that can be read.
export function shortNumber(value, digits = 3) {
  if (!Number.isFinite(value)) return '-';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e7) return value.toExponential(digits - 1);
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return value.toFixed(Math.min(decimals, 8));
}

const prefixes = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, '']];

// "278 kN": the unit gets the prefix that suits the value.
export function withUnit(value, unit, digits = 3) {
  if (!Number.isFinite(value)) return '-';
  const [size, prefix] = prefixes.find(([limit]) => Math.abs(value) >= limit) ?? [1, ''];
  return `${shortNumber(value / size, digits)} ${prefix}${unit}`;
}

export function clockText(seconds) {
  const whole = Math.max(0, Math.floor(seconds));
  const two = n => String(n).padStart(2, '0');
  return `${Math.floor(whole / 3600)}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
}
