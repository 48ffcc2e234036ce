// Writes colour_maps.json, the maps that the program embeds. Run it only to change the set:
//   npm install d3-scale-chromatic d3-color colormap && node generate_colour_maps.mjs > colour_maps.json
// Sequential and ColorBrewer maps are sampled from the npm packages named as `source`; diverging maps are computed here.
import * as chromatic from 'd3-scale-chromatic';
import { rgb } from 'd3-color';
import { createRequire } from 'node:module';
const colormapScales = createRequire(import.meta.url)('colormap/colorScale.js');

const round = x => Math.round(x * 1e4) / 1e4;
const evenly = (n, colourAt) => Array.from({ length: n }, (_, i) => {
    const position = i / (n - 1);
    return [round(position), ...colourAt(position).map(round)];
});

function fromD3(interpolator, n, reversed = false) {
    return evenly(n, t => {
        const c = rgb(interpolator(reversed ? 1 - t : t));
        return [c.r / 255, c.g / 255, c.b / 255];
    });
}
const fromColormap = name => colormapScales[name].map(s => [round(s.index), ...s.rgb.map(v => round(v / 255))]);

// Moreland 2009, "Diverging Color Maps for Scientific Visualization", section 4 and appendix: interpolation in Msh.
const white = [0.9505, 1.0, 1.089];
const toLinear = v => (v > 0.04045 ? ((v + 0.055) / 1.055) ** 2.4 : v / 12.92);
const toDisplay = v => (v > 0.0031308 ? 1.055 * v ** (1 / 2.4) - 0.055 : 12.92 * v);
function mshFromRgb(colour) {
    const [r, g, b] = colour.map(toLinear);
    const xyz = [0.4124 * r + 0.3576 * g + 0.1805 * b, 0.2126 * r + 0.7152 * g + 0.0722 * b, 0.0193 * r + 0.1192 * g + 0.9505 * b];
    const f = xyz.map((v, i) => { const t = v / white[i]; return t > 0.008856 ? Math.cbrt(t) : 7.787 * t + 16 / 116; });
    const [L, a, bb] = [116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])];
    const M = Math.hypot(L, a, bb);
    return [M, Math.acos(L / M), Math.atan2(bb, a)];
}
function rgbFromMsh([M, s, h]) {
    const [L, a, b] = [M * Math.cos(s), M * Math.sin(s) * Math.cos(h), M * Math.sin(s) * Math.sin(h)];
    const fy = (L + 16) / 116;
    const xyz = [fy + a / 500, fy, fy - b / 200].map((t, i) => white[i] * (t ** 3 > 0.008856 ? t ** 3 : (t - 16 / 116) / 7.787));
    const linear = [
        3.2406 * xyz[0] - 1.5372 * xyz[1] - 0.4986 * xyz[2], -0.9689 * xyz[0] + 1.8758 * xyz[1] + 0.0415 * xyz[2],
        0.0557 * xyz[0] - 0.204 * xyz[1] + 1.057 * xyz[2]];
    return linear.map(v => Math.min(1, Math.max(0, toDisplay(Math.max(0, v)))));
}
// The neutral middle has no hue: give it the one that makes the least turn in hue (appendix, "adjustHue").
function adjustedHue([M, s, h], neutralM) {
    if (M >= neutralM) return h;
    const spin = s * Math.sqrt(neutralM * neutralM - M * M) / (M * Math.sin(s));
    return h > -Math.PI / 3 ? h + spin : h - spin;
}
function moreland(low, high, n = 33) {
    const ends = [mshFromRgb(low), mshFromRgb(high)];
    const middleM = Math.max(ends[0][0], ends[1][0], 88);
    return evenly(n, t => {
        const end = t < 0.5 ? ends[0] : ends[1];
        const middle = [middleM, 0, adjustedHue(end, middleM)];
        const w = Math.abs(2 * t - 1); // 1 at the end, 0 in the middle
        return rgbFromMsh(end.map((v, i) => w * v + (1 - w) * middle[i]));
    });
}

const d3 = 'd3-scale-chromatic 3 (ISC)';
const brewer = 'ColorBrewer (Brewer and Harrower), sampled from d3-scale-chromatic 3';
const morelandSource = 'computed after Moreland 2009, Diverging Color Maps for Scientific Visualization';
const sequential = (name, label, stops, source) => ({ name, label, kind: 'sequential', source, stops });
const diverging = (name, label, stops, source) => ({ name, label, kind: 'diverging', pivot: 0.5, source, stops });

const slicer = '3D Slicer volume rendering presets (scalar colours and opacities)';
// stops and opacity of CT presets are at Hounsfield units; window = the part of the scale that is shown by default.
const ct = (name, label, window, stops, opacity) => ({ name, label, kind: 'ct', unit: 'HU', source: slicer, window, stops, opacity });

const maps = [
    sequential('viridis', 'Viridis', fromD3(chromatic.interpolateViridis, 65), d3 + ', after van der Walt and Smith'),
    sequential('plasma', 'Plasma', fromD3(chromatic.interpolatePlasma, 65), d3 + ', after van der Walt and Smith'),
    sequential('inferno', 'Inferno', fromD3(chromatic.interpolateInferno, 65), d3 + ', after van der Walt and Smith'),
    sequential('magma', 'Magma', fromD3(chromatic.interpolateMagma, 65), d3 + ', after van der Walt and Smith'),
    sequential('cividis', 'Cividis', fromD3(chromatic.interpolateCividis, 65), d3 + ', after Nunez, Anderton and Renslow 2018'),
    sequential('turbo', 'Turbo', fromD3(chromatic.interpolateTurbo, 65), d3 + ', after Mikhailov 2019'),
    sequential('grey', 'Grey', [[0, 0, 0, 0], [1, 1, 1, 1]], 'linear in display sRGB'),
    sequential('cubehelix', 'Cubehelix', fromD3(chromatic.interpolateCubehelixDefault, 65), d3 + ', after Green 2011'),
    sequential('blues', 'Blues', fromD3(chromatic.interpolateBlues, 33, true), brewer),
    sequential('yellow-green-blue', 'Yellow green blue', fromD3(chromatic.interpolateYlGnBu, 33, true), brewer),
    sequential('black-body', 'Black body', fromColormap('blackbody'), 'colormap 2.3 (MIT)'),
    sequential('hot', 'Hot', fromColormap('hot'), 'colormap 2.3 (MIT)'),
    sequential('bone', 'Bone', fromColormap('bone'), 'colormap 2.3 (MIT)'),
    sequential('copper', 'Copper', fromColormap('copper'), 'colormap 2.3 (MIT)'),
    sequential('jet', 'Jet (not even in lightness)', fromColormap('jet'), 'colormap 2.3 (MIT)'),
    diverging('cool-warm', 'Cool warm', moreland([0.23, 0.299, 0.754], [0.706, 0.016, 0.15]), morelandSource),
    diverging('purple-orange', 'Purple orange', moreland([0.436, 0.308, 0.631], [0.759, 0.334, 0.046]), morelandSource),
    diverging('blue-tan', 'Blue tan', moreland([0.217, 0.525, 0.91], [0.677, 0.492, 0.093]), morelandSource),
    diverging('green-purple', 'Green purple', moreland([0.085, 0.532, 0.201], [0.436, 0.308, 0.631]), morelandSource),
    diverging('red-blue', 'Red blue', fromD3(chromatic.interpolateRdBu, 33), brewer),
    diverging('brown-teal', 'Brown teal', fromD3(chromatic.interpolateBrBG, 33), brewer),
    diverging('spectral', 'Spectral', fromD3(chromatic.interpolateSpectral, 33), brewer),
    ct('ct-bone', 'CT bone', [-200, 1500],
        [[-3024, 0, 0, 0], [-16.4458, 0.729412, 0.254902, 0.301961], [641.385, 0.905882, 0.815686, 0.552941], [3071, 1, 1, 1]],
        [[-3024, 0], [-16.4458, 0], [641.385, 0.715686], [3071, 0.705882]]),
    ct('ct-muscle', 'CT muscle', [-300, 700],
        [[-3024, 0, 0, 0], [-155.407, 0.54902, 0.25098, 0.14902], [217.641, 0.882353, 0.603922, 0.290196],
            [419.736, 1, 0.937033, 0.954531], [3071, 0.827451, 0.658824, 1]],
        [[-3024, 0], [-155.407, 0], [217.641, 0.676471], [419.736, 0.833333], [3071, 0.803922]]),
    ct('ct-soft-tissue', 'CT soft tissue', [-200, 300],
        [[-2048, 0, 0, 0], [-167.01, 0, 0, 0], [-160, 0.0556356, 0.0556356, 0.0556356], [240, 1, 1, 1], [3661, 1, 1, 1]],
        [[-2048, 0], [-167.01, 0], [-160, 1], [240, 1], [3661, 1]]),
    ct('ct-lung', 'CT lung', [-1000, 200],
        [[-1000, 0.3, 0.3, 1], [-600, 0, 0, 1], [-530, 0.134704, 0.781726, 0.0724558], [-460, 0.929244, 1, 0.109473],
            [-400, 0.888889, 0.254949, 0.0240258], [2952, 1, 0.3, 0.3]],
        [[-1000, 0], [-600, 0], [-599, 0.15], [-400, 0.15], [-399, 0], [2952, 0]]),
];
console.log('{"maps": [\n' + maps.map(m => JSON.stringify(m)).join(',\n') + '\n]}');
