// Colour maps that people with any colour vision can read: by lightness (viridis) or from blue over grey to orange.

const anchors = {
  viridis: ['440154', '482475', '414487', '355f8d', '2a788e', '21918c', '22a884', '44bf70', '7ad151', 'bddf26', 'fde725'],
  blue_orange: ['1f4e8c', '4f83bd', '9fbcd8', 'd9dcdd', 'e9b88a', 'd4813a', '97510f'],
  classes: ['4477aa', 'ee9944', '228833', 'aa3377', '66ccee', 'ccbb44', 'bbbbbb'],
};

const channels = hex => [0, 2, 4].map(at => parseInt(hex.slice(at, at + 2), 16));

// 256 colours as bytes r, g, b, a.
export function colourTable(name) {
  const points = anchors[name].map(channels);
  const table = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) {
    const at = i / 255 * (points.length - 1), low = Math.min(Math.floor(at), points.length - 2);
    for (let c = 0; c < 3; ++c) table[4 * i + c] = points[low][c] + (at - low) * (points[low + 1][c] - points[low][c]);
    table[4 * i + 3] = 255;
  }
  return table;
}

export const tableColour = (table, share) => {
  const i = 4 * Math.round(255 * Math.min(1, Math.max(0, share)));
  return `rgb(${table[i]},${table[i + 1]},${table[i + 2]})`;
};
