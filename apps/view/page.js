// The page of an event: detector in 3D, light in time, cascades, ice. Everything is drawn on 2D canvases: a
// detector has some thousand modules, which needs no graphics card, and works wherever a browser does.
"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const element = (id) => document.getElementById(id);
  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const degree = Math.PI / 180;
  const originDepth = 1948.07;  // of z = 0 below the surface [m]

  // ---- Numbers as words

  const fixed = (value, digits) => (Math.abs(value) < 0.5 * 10 ** -digits ? 0 : value).toFixed(digits);
  function charge(value) {
    if (value >= 1e5) return value.toExponential(2).replace("e+", "e");
    return value >= 100 ? value.toFixed(0) : value >= 10 ? value.toFixed(1) : String(+value.toPrecision(2));
  }
  function energy(gev) {
    const units = [[1e9, "EeV"], [1e6, "PeV"], [1e3, "TeV"]];
    for (const [size, unit] of units)
      if (gev >= size) return `${+ (gev / size).toPrecision(4)} ${unit}`;
    return `${+ gev.toPrecision(4)} GeV`;
  }
  const thousands = (n) => n.toLocaleString("en");

  // Round values in [low, high], about `count` of them.
  function ticks(low, high, count) {
    const rough = (high - low) / count;
    if (!(rough > 0)) return [];
    const decade = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((f) => f * decade).find((s) => s >= rough);
    const result = [];
    for (let v = Math.ceil(low / step) * step; v <= high + 1e-9 * step; v += step)
      result.push(+v.toPrecision(12));
    return result;
  }

  // ---- Light: curves of modules with running sums, so that any window of time costs two searches

  const detector = data.detector;
  const moduleCount = detector.x.length;
  const binWidth = data.time.bin_width;
  const timeOf = (bin) => data.time.begin + bin * binWidth;

  const curveOf = new Array(moduleCount).fill(null);
  for (const curve of data.curves) {
    let bin = 0;
    curve.at = Float64Array.from(curve.bins, (step) => (bin += step));
    curve.sums = new Float64Array(curve.at.length + 1);
    curve.charges.forEach((q, i) => {
      curve.sums[i + 1] = curve.sums[i] + q;
    });
    curveOf[curve.module] = curve;
  }
  const byCharge = data.curves.slice().sort((a, b) => b.charge - a.charge);
  const totalCharge = data.curves.reduce((sum, curve) => sum + curve.charge, 0);

  // The first index whose bin ends after time t.
  function search(curve, t) {
    let low = 0, high = curve.at.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (timeOf(curve.at[middle] + 1) > t)
        high = middle;
      else
        low = middle + 1;
    }
    return low;
  }
  // Charge between two times, in whole bins, and when it begins.
  function lightBetween(curve, from, to) {
    const first = search(curve, from), end = to === Infinity ? curve.at.length : search(curve, to);
    const q = curve.sums[end] - curve.sums[first];
    return {charge: q, first: first < end ? Math.max(timeOf(curve.at[first]), curve.first) : NaN};
  }

  function quantile(values, weights, share) {
    const order = values.map((_, i) => i).sort((a, b) => values[a] - values[b]);
    const all = weights.reduce((a, b) => a + b, 0);
    let sum = 0;
    for (const i of order)
      if ((sum += weights[i]) >= share * all) return values[i];
    return values.length ? values[order[order.length - 1]] : 0;
  }
  // Afterpulses and noise come long after: the time axis shows where most light is, its right end stands for
  // all that follows.
  const allBins = [], allCharges = [];
  for (const curve of data.curves)
    curve.at.forEach((bin, i) => {
      allBins.push(timeOf(bin));
      allCharges.push(curve.charges[i]);
    });
  const span = {low: data.time.begin, high: data.time.end};
  if (allBins.length) {
    const late = quantile(allBins, allCharges, 0.998), early = quantile(allBins, allCharges, 0.0005);
    const margin = 0.04 * Math.max(late - early, 50);
    span.low = Math.max(span.low, Math.floor(early - margin));
    span.high = Math.min(span.high, Math.ceil(late + margin));
  }
  if (!(span.high > span.low)) span.high = span.low + 1;
  const firsts = data.curves.map((curve) => curve.first), ones = firsts.map(() => 1);
  const colourSpan = {low: quantile(firsts, ones, 0.02), high: quantile(firsts, ones, 0.9)};
  if (!(colourSpan.high > colourSpan.low)) colourSpan.high = colourSpan.low + 1;

  // ---- Colours of time: red is early, violet late, as event displays of neutrino telescopes have it

  const stops = [
    [214, 39, 40], [244, 109, 48], [250, 190, 50], [120, 190, 80], [38, 166, 154], [46, 111, 200],
    [106, 61, 170]
  ];
  const shades = 64;
  function colourAt(share) {
    const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
    const i = Math.min(Math.floor(place), stops.length - 2), f = place - i;
    return stops[i].map((c, k) => Math.round(c + f * (stops[i + 1][k] - c)));
  }
  const rgb = (c, alpha = 1) => `rgba(${c[0]},${c[1]},${c[2]},${alpha})`;
  const shadeOf = (time) => Math.min(
      shades - 1,
      Math.max(0, Math.round((time - colourSpan.low) / (colourSpan.high - colourSpan.low) * (shades - 1))));
  // A lit sphere for each shade, drawn once.
  const spheres = Array.from({length: shades}, (_, i) => {
    const sprite = document.createElement("canvas"), size = 96, c = colourAt(i / (shades - 1));
    sprite.width = sprite.height = size;
    const pen = sprite.getContext("2d"), middle = size / 2;
    const light = pen.createRadialGradient(middle * 0.7, middle * 0.62, size * 0.03, middle, middle, middle);
    light.addColorStop(0, rgb(c.map((v) => v + 0.62 * (255 - v))));
    light.addColorStop(0.45, rgb(c));
    light.addColorStop(1, rgb(c.map((v) => v * 0.55)));
    pen.fillStyle = light;
    pen.beginPath();
    pen.arc(middle, middle, middle - 1, 0, 2 * Math.PI);
    pen.fill();
    return sprite;
  });

  // Radius of a module [m] for a charge: a cube root and less, so that single photons and thousands both
  // show.
  const mostCharge = byCharge.length ? byCharge[0].charge : 1;
  const leastCharge = byCharge.length ? Math.min(mostCharge, 0.99 * byCharge[byCharge.length - 1].charge) : 1;
  const power = 0.3, largestRadius = Math.min(30, 4.5 * mostCharge ** power);
  const radiusOf = (q) => largestRadius * (q / mostCharge) ** power;

  // ---- State

  const extent = (key) =>
      detector[key].reduce((e, v) => [Math.min(e[0], v), Math.max(e[1], v)], [Infinity, -Infinity]);
  const box = {x: extent("x"), y: extent("y"), z: extent("z")};
  const middle = (e) => (e[0] + e[1]) / 2;
  const reach = Math.max(box.x[1] - box.x[0], box.y[1] - box.y[0], box.z[1] - box.z[0], 100);
  const floorZ = box.z[0] - 0.04 * reach;

  const camera = {};
  // `lens`: the eye stands so many times farther away and looks through so much longer a lens: less
  // perspective.
  function look(yaw, pitch, lens = 1) {
    Object.assign(camera, {
      yaw,
      pitch,
      lens,
      distance: 3 * reach,
      target: [middle(box.x), middle(box.y), middle(box.z) - 0.02 * reach]
    });
  }
  look(-60 * degree, 14 * degree);
  const window_ = {from: -Infinity, to: Infinity};  // of time [ns]
  let selected = -1, hovered = -1, playing = null;

  // ---- Canvases

  // Sized in pixels of the screen; drawing is in CSS pixels.
  function penOf(canvas) {
    const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.font = "12px " + getComputedStyle(document.body).fontFamily;
    return {pen, width, height};
  }
  let asked = false;
  function draw() {
    asked = false;
    drawScene();
    drawTimeline();
    drawModule();
  }
  function redraw() {
    if (asked) return;
    asked = true;
    requestAnimationFrame(draw);
  }

  // ---- The scene

  const view = element("view");
  let project = null;  // of the last picture: [x, y, z] -> {x, y, depth, scale: pixels a metre}
  let placed = [];     // modules with light in the last picture: {module, x, y, radius}

  function projection(width, height) {
    const cy = Math.cos(camera.yaw), sy = Math.sin(camera.yaw), cp = Math.cos(camera.pitch),
          sp = Math.sin(camera.pitch);
    const focal = camera.lens * Math.min(2.25 * height, 1.4 * width);
    const centre = width / 2 + (width > 700 ? 90 : 0);  // the legend stands on the left
    const [tx, ty, tz] = camera.target;
    return (x, y, z) => {
      const dx = x - tx, dy = y - ty, dz = z - tz;
      const depth = camera.lens * camera.distance - (dx * cp * cy + dy * cp * sy + dz * sp);
      if (depth < 1) return null;  // behind the eye
      const scale = focal / depth;
      return {
        x: centre + scale * (-dx * sy + dy * cy),
        y: 0.46 * height - scale * (-dx * sp * cy - dy * sp * sy + dz * cp),
        depth,
        scale
      };
    };
  }

  function line(pen, a, b) {
    const p = project(...a), q = project(...b);
    if (!p || !q) return;
    pen.beginPath();
    pen.moveTo(p.x, p.y);
    pen.lineTo(q.x, q.y);
    pen.stroke();
  }
  function word(pen, at, text, align = "center", shift = [0, 0]) {
    const p = project(...at);
    if (!p) return;
    pen.textAlign = align;
    pen.textBaseline = "middle";
    pen.fillText(text, p.x + shift[0], p.y + shift[1]);
  }

  function drawFloor(pen) {
    const step = reach > 700 ? 200 : reach > 300 ? 100 : 50;
    const low = (e) => Math.floor((e[0] - 20) / step) * step,
          high = (e) => Math.ceil((e[1] + 20) / step) * step;
    const x0 = low(box.x), x1 = high(box.x), y0 = low(box.y), y1 = high(box.y);
    pen.strokeStyle = css("--grid");
    pen.lineWidth = 1;
    for (let x = x0; x <= x1; x += step) line(pen, [x, y0, floorZ], [x, y1, floorZ]);
    for (let y = y0; y <= y1; y += step) line(pen, [x0, y, floorZ], [x1, y, floorZ]);
    // Labels on the sides that face the eye.
    const nearX = Math.cos(camera.yaw) > 0 ? x1 : x0, nearY = Math.sin(camera.yaw) > 0 ? y1 : y0;
    const out = 0.035 * reach;
    pen.fillStyle = css("--faint");
    for (let x = x0; x <= x1; x += step)
      word(pen, [x, nearY + Math.sign(nearY - middle(box.y)) * out, floorZ], String(x));
    for (let y = y0; y <= y1; y += step)
      word(pen, [nearX + Math.sign(nearX - middle(box.x)) * out, y, floorZ], String(y));
    word(pen, [middle(box.x), nearY + Math.sign(nearY - middle(box.y)) * 3 * out, floorZ], "x [m]");
    word(pen, [nearX + Math.sign(nearX - middle(box.x)) * 3 * out, middle(box.y), floorZ], "y [m]");
    return {x0, x1, y0, y1};
  }

  // A flat column that always faces the eye, to the left of the detector; dark where there is dust.
  function drawColumn(pen) {
    if (Math.abs(camera.pitch) > 65 * degree) return;  // from above it is but a point
    const cy = Math.cos(camera.yaw), sy = Math.sin(camera.yaw),
          away = 0.5 * Math.hypot(box.x[1] - box.x[0], box.y[1] - box.y[0]) + 0.06 * reach;
    const at = (side, z) => [middle(box.x) + sy * (away + side), middle(box.y) - cy * (away + side), z];
    const width = 0.035 * reach;
    if (data.ice) {
      const dust = data.ice.absorption.map(Math.log), least = Math.min(...dust), most = Math.max(...dust);
      const c = css("--dust");
      data.ice.z.forEach((z, i) => {
        const half = data.ice.step / 2 * 1.04;
        const corners = [at(0, z - half), at(width, z - half), at(width, z + half), at(0, z + half)].map(
            (p) => project(...p));
        if (corners.some((p) => !p)) return;
        pen.globalAlpha = 0.06 + 0.9 * (dust[i] - least) / Math.max(most - least, 1e-9);
        pen.fillStyle = c;
        pen.beginPath();
        corners.forEach((p) => pen.lineTo(p.x, p.y));
        pen.fill();
      });
      pen.globalAlpha = 1;
    }
    const inner = data.ice ? width : 0;
    pen.strokeStyle = pen.fillStyle = css("--faint");
    pen.lineWidth = 1;
    line(pen, at(inner, box.z[0]), at(inner, box.z[1]));
    for (const depth of ticks(originDepth - box.z[1], originDepth - box.z[0], 6)) {
      const z = originDepth - depth;
      line(pen, at(inner, z), at(inner + 0.01 * reach, z));
      word(pen, at(inner + 0.015 * reach, z), String(depth), "right");
    }
    word(pen, at(inner / 2, box.z[1] + 0.09 * reach), data.ice ? "dust, depth [m]" : "depth [m]", "center");
  }

  function arrow(pen, from, to, colour, width, dashes = []) {
    const p = project(...from), q = project(...to);
    if (!p || !q) return;
    pen.strokeStyle = pen.fillStyle = colour;
    pen.lineWidth = width;
    pen.setLineDash(dashes);
    pen.beginPath();
    pen.moveTo(p.x, p.y);
    pen.lineTo(q.x, q.y);
    pen.stroke();
    pen.setLineDash([]);
    const angle = Math.atan2(q.y - p.y, q.x - p.x), size = 4 + 2.5 * width;
    pen.beginPath();
    pen.moveTo(q.x + 2 * Math.cos(angle), q.y + 2 * Math.sin(angle));
    for (const side of [2.65, -2.65])
      pen.lineTo(q.x + size * Math.cos(angle + side), q.y + size * Math.sin(angle + side));
    pen.fill();
  }

  function drawFlow(pen, floor) {
    if (!data.ice) return;
    const azimuth = data.ice.flow_azimuth_deg * degree, half = 0.15 * reach;
    // On the floor between detector and eye, where no module hides it.
    const x = (floor.x0 + floor.x1) / 2 + 0.33 * reach * Math.cos(camera.yaw),
          y = (floor.y0 + floor.y1) / 2 + 0.33 * reach * Math.sin(camera.yaw);
    const d = [half * Math.cos(azimuth), half * Math.sin(azimuth)];
    arrow(pen, [x - d[0], y - d[1], floorZ], [x + d[0], y + d[1], floorZ], css("--flow"), 3);
    word(
        pen, [x + d[0] * 1.1, y + d[1] * 1.1, floorZ], `ice flow, ${fixed(data.ice.flow_azimuth_deg, 0)}°`,
        "center", [0, -10]);
  }

  const travel = (p) =>
      [-Math.sin(p.zenith_deg * degree) * Math.cos(p.azimuth_deg * degree),
       -Math.sin(p.zenith_deg * degree) * Math.sin(p.azimuth_deg * degree), -Math.cos(p.zenith_deg * degree)];
  const along = (p, way) => travel(p).map((c, i) => [p.x, p.y, p.z][i] + way * c);

  function drawParticle(pen, particle, colour, width, dashes) {
    const length = particle.length > 0 ? particle.length : 0.2 * reach;
    if (particle.name !== "ph")
      arrow(
          pen, along(particle, particle.length > 0 ? 0 : -0.04 * reach), along(particle, length), colour,
          width, dashes);
    const p = project(particle.x, particle.y, particle.z);
    if (!p) return;
    pen.fillStyle = colour;
    pen.strokeStyle = css("--scene");
    pen.lineWidth = 1.5;
    pen.beginPath();
    pen.arc(p.x, p.y, 5, 0, 2 * Math.PI);
    pen.fill();
    pen.stroke();
  }

  function drawLights(pen) {
    for (const light of data.light) {
      const p = project(light.x, light.y, light.z);
      if (!p) continue;
      pen.strokeStyle = css("--light");
      pen.lineWidth = 2;
      for (let k = 0; k < 8; ++k) {
        const a = k * Math.PI / 4;
        pen.beginPath();
        pen.moveTo(p.x + 4 * Math.cos(a), p.y + 4 * Math.sin(a));
        pen.lineTo(p.x + 10 * Math.cos(a), p.y + 10 * Math.sin(a));
        pen.stroke();
      }
    }
  }

  const strings = new Map();
  for (let i = 0; i < moduleCount; ++i) {
    if (!strings.has(detector.string[i])) strings.set(detector.string[i], []);
    strings.get(detector.string[i]).push(i);
  }

  function drawDark(pen) {
    pen.strokeStyle = css("--string");
    pen.lineWidth = 1;
    for (const modules of strings.values()) {
      const a = modules[0], b = modules[modules.length - 1];
      line(pen, [detector.x[a], detector.y[a], detector.z[a]], [detector.x[b], detector.y[b], detector.z[b]]);
    }
    pen.fillStyle = css("--module");
    for (let i = 0; i < moduleCount; ++i) {
      const p = project(detector.x[i], detector.y[i], detector.z[i]);
      if (!p) continue;
      const size = Math.min(Math.max(1.6 * p.scale, 1), 3.5);
      pen.globalAlpha = detector.on[i] ? 0.8 : 0.25;
      pen.fillRect(p.x - size / 2, p.y - size / 2, size, size);
    }
    pen.globalAlpha = 1;
  }

  function drawLit(pen) {
    placed = [];
    for (const curve of data.curves) {
      const i = curve.module, light = lightBetween(curve, window_.from, window_.to);
      if (!(light.charge > 0)) continue;
      const p = project(detector.x[i], detector.y[i], detector.z[i]);
      if (p)
        placed.push({
          module: i,
          x: p.x,
          y: p.y,
          depth: p.depth,
          radius: Math.max(radiusOf(light.charge) * p.scale, 2),
          shade: shadeOf(light.first)
        });
    }
    placed.sort((a, b) => b.depth - a.depth);
    for (const p of placed)
      pen.drawImage(spheres[p.shade], p.x - p.radius, p.y - p.radius, 2 * p.radius, 2 * p.radius);
  }

  function ring(pen, module, colour, width) {
    const p = module >= 0 && project(detector.x[module], detector.y[module], detector.z[module]);
    if (!p) return;
    const lit = placed.find((q) => q.module === module);
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.beginPath();
    pen.arc(p.x, p.y, (lit ? lit.radius : 3) + 4, 0, 2 * Math.PI);
    pen.stroke();
  }

  function drawScene() {
    const {pen, width, height} = penOf(view);
    if (!width || !height) return;
    project = projection(width, height);
    const floor = drawFloor(pen);
    drawFlow(pen, floor);
    drawColumn(pen);
    drawDark(pen);
    drawLit(pen);
    data.truth.slice(0, 200).forEach((particle) => drawParticle(pen, particle, css("--true"), 4.5, []));
    data.fits.forEach((fit, i) => drawParticle(pen, fit, css(i ? "--second" : "--fit"), 2, [7, 4]));
    drawLights(pen);
    ring(pen, hovered, css("--faint"), 1.5);
    ring(pen, selected, css("--accent"), 2.5);
    drawSizes();
  }

  // ---- The legend

  function drawSizes() {
    const scale = project(...camera.target)?.scale ?? 0.5;
    const decades = [];
    for (let k = Math.floor(Math.log10(mostCharge));
         !decades.length || (decades.length < 4 && 10 ** k >= leastCharge); --k)
      decades.unshift(10 ** k);
    element("sizes").replaceChildren(...decades.map((q) => {
      const item = document.createElement("span"), disc = document.createElement("i");
      disc.style.width = disc.style.height = `${Math.min(2 * Math.max(radiusOf(q) * scale, 2), 44)}px`;
      item.append(disc, `${q >= 1e4 ? q.toExponential(0).replace("e+", "e") : +q.toPrecision(1)}`);
      return item;
    }));
  }
  function symbol(colour, text, style = "solid") {
    const item = document.createElement("li"), mark = document.createElement("b");
    mark.style.borderTopColor = `var(${colour})`;
    mark.style.borderTopStyle = style;
    item.append(mark, text);
    return item;
  }
  function fillLegend() {
    const colours = Array.from({length: 13}, (_, i) => rgb(colourAt(i / 12)));
    element("colours").style.background = `linear-gradient(to right, ${colours.join(",")})`;
    const at = (share) => Math.round(colourSpan.low + share * (colourSpan.high - colourSpan.low));
    element("colour-ticks").replaceChildren(...[`≤ ${at(0)}`, `${at(0.5)}`, `≥ ${at(1)} ns`].map((text) => {
      const tick = document.createElement("span");
      tick.textContent = text;
      return tick;
    }));
    const items = [];
    if (data.truth.length)
      items.push(symbol("--true", data.truth.length > 1 ? `truth: ${data.truth.length} particles` : "truth"));
    data.fits.forEach((fit, i) => items.push(symbol(i ? "--second" : "--fit", fit.name, "dashed")));
    for (const light of data.light) items.push(symbol("--light", `light of ${light.label}`));
    if (data.ice) items.push(symbol("--flow", "flow of the ice"), symbol("--dust", "dust: absorption"));
    element("symbols").replaceChildren(...items);
  }

  // ---- Axes of the small pictures

  // Draws the frame; returns x(value) and y(value) in pixels.
  function axes(pen, frame, xs, ys, xWord, yWord) {
    const {left, right, top, bottom} = frame;
    const x = (v) => left + (v - xs[0]) / (xs[1] - xs[0]) * (right - left);
    const y = (v) => bottom - (v - ys[0]) / (ys[1] - ys[0]) * (bottom - top);
    pen.strokeStyle = css("--edge");
    pen.fillStyle = css("--faint");
    pen.lineWidth = 1;
    pen.font = pen.font.replace(/^\d+px/, "11px");
    pen.textBaseline = "top";
    pen.textAlign = "center";
    for (const v of ticks(xs[0], xs[1], 4)) {
      pen.beginPath();
      pen.moveTo(x(v), bottom);
      pen.lineTo(x(v), bottom + 4);
      pen.stroke();
      pen.fillText(String(v), x(v), bottom + 6);
    }
    pen.fillText(xWord, (left + right) / 2, bottom + 20);
    pen.textBaseline = "middle";
    pen.textAlign = "right";
    for (const v of ticks(Math.min(...ys), Math.max(...ys), 4)) {
      pen.beginPath();
      pen.moveTo(left, y(v));
      pen.lineTo(right, y(v));
      pen.stroke();
      pen.fillText(Math.abs(v) >= 1e4 ? v.toExponential(0).replace("e+", "e") : String(v), left - 5, y(v));
    }
    pen.save();
    pen.translate(9, (top + bottom) / 2);
    pen.rotate(-Math.PI / 2);
    pen.textAlign = "center";
    pen.fillText(yWord, 0, 0);
    pen.restore();
    return {x, y};
  }

  // ---- The module that is selected

  const wavesOf = new Map();
  for (const wave of data.waveforms) {
    if (!wavesOf.has(wave.module)) wavesOf.set(wave.module, []);
    wavesOf.get(wave.module).push(wave);
  }

  // Bins so wide that some 90 fill the picture, over the time that holds all but the last hundredth of light.
  function barsOf(curve) {
    const end = curve.sums[curve.sums.length - 1];
    let last = curve.at.length - 1;
    while (last > 0 && curve.sums[last] > 0.99 * end) --last;
    const first = curve.at[0], bins = curve.at[last] - first + 1;
    const together =
        [1, 2, 5, 10, 20, 50, 100, 200, 500, 1e3, 2e3, 5e3, 1e4, 1e5, 1e6, 1e7].find((m) => bins / m <= 90) ||
        bins;
    const start = Math.floor(first / together),
          bars = new Float64Array(Math.floor(curve.at[last] / together) - start + 1);
    for (let i = 0; i <= last; ++i) bars[Math.floor(curve.at[i] / together) - start] += curve.charges[i];
    return {bars, from: timeOf(start * together), width: together * binWidth};
  }

  function drawCurve(curve) {
    const {pen, width, height} = penOf(element("curve"));
    const {bars, from, width: barWidth} = barsOf(curve);
    const pad = Math.max(1, 0.04 * bars.length) * barWidth;
    const xs = [from - pad, from + bars.length * barWidth + pad], ys = [0, 1.08 * Math.max(...bars)];
    const frame = {left: 52, right: width - 10, top: 8, bottom: height - 36};
    const {x, y} = axes(pen, frame, xs, ys, "time [ns]", `pe in ${barWidth} ns`);
    bars.forEach((q, i) => {
      if (!q) return;
      const t = from + i * barWidth, inside = t + barWidth > window_.from && t < window_.to;
      pen.fillStyle = rgb(colourAt(shadeOf(t) / (shades - 1)), inside ? 1 : 0.25);
      pen.fillRect(x(t), y(q), Math.max(x(t + barWidth) - x(t) - 0.5, 1), frame.bottom - y(q));
    });
    element("curve-caption").textContent = `Light in time, as stored in bins of ${binWidth} ns.`;
  }

  // Where the first trace begins, to where the last one is within 2% of its quiet again.
  function spanOf(waves, most) {
    const low = Math.min(...waves.map((w) => w.time));
    let high = low + 400;
    for (const w of waves)
      w.millivolts.forEach((v, i) => {
        if (Math.abs(v) > 0.02 * most) high = Math.max(high, w.time + (i + 3) * w.sample);
      });
    return [low, high];
  }

  const digitiserColours = {atwd0: "--accent", atwd1: "--second", atwd2: "--light", fadc: "--fit"};
  function drawWaves(waves) {
    const {pen, width, height} = penOf(element("waveform"));
    const all = waves.flatMap((w) => w.millivolts), floor = Math.min(0, ...all), most = Math.max(1, ...all);
    const frame = {left: 52, right: width - 10, top: 8, bottom: height - 36}, span = spanOf(waves, most);
    const {x, y} =
        axes(pen, frame, span, [floor, floor + 1.08 * (most - floor)], "time [ns]", "voltage [mV]");
    for (const wave of waves) {
      pen.strokeStyle = css(digitiserColours[wave.digitiser] || "--ink");
      pen.lineWidth = 1.4;
      pen.beginPath();
      wave.millivolts.forEach((v, i) => {
        const t = wave.time + i * wave.sample;
        if (t <= span[1]) pen.lineTo(x(t), y(v));
      });
      pen.stroke();
    }
    const names = [...new Set(waves.map((w) => w.digitiser))];
    element("waveform-caption")
        .replaceChildren("Digitised, first repetition: ", ...names.flatMap((name, i) => {
          const word = Object.assign(document.createElement("b"), {textContent: name});
          word.style.color = `var(${digitiserColours[name] || "--ink"})`;
          return i ? [", ", word] : [word];
        }));
  }

  const nameOf = (i) => `${detector.string[i]},${detector.dom[i]}`;
  function drawModule() {
    const curve = selected >= 0 ? curveOf[selected] : null, waves = wavesOf.get(selected);
    element("curve-figure").hidden = !curve;
    element("waveform-figure").hidden = !waves;
    if (selected < 0) {
      element("module-title").textContent = "No module selected";
      element("module-text").textContent = byCharge.length ?
          "Click on a module, or press N for the brightest one." :
          "No module has seen light.";
      return;
    }
    element("module-title").textContent = `Module ${nameOf(selected)}`;
    const place = `x ${fixed(detector.x[selected], 1)}, y ${fixed(detector.y[selected], 1)}, z ${
        fixed(detector.z[selected], 1)} m (${fixed(originDepth - detector.z[selected], 1)} m deep)`;
    element("module-text").textContent = curve ?
        `${place}. ${charge(curve.charge)} pe in ${thousands(curve.hits)} ${
            curve.hits === 1 ? "hit" : "hits"}, the first at ${fixed(curve.first, 1)} ns.` :
        `${place}. ${detector.on[selected] ? "It saw no light." : "It is switched off."}`;
    if (curve) drawCurve(curve);
    if (waves) drawWaves(waves);
  }

  function select(module) {
    selected = module;
    document.body.dataset.selected = module >= 0 ? nameOf(module) : "";
    redraw();
  }
  function selectNext(step) {
    if (!byCharge.length) return;
    const now = byCharge.findIndex((curve) => curve.module === selected);
    select(byCharge[now < 0 ? 0 : (now + step + byCharge.length) % byCharge.length].module);
  }

  // ---- Cascades: truth beside fits

  const quantities = [
    ["x [m]", "x", 1], ["y [m]", "y", 1], ["z [m]", "z", 1], ["time [ns]", "time", 1],
    ["zenith [deg]", "zenith_deg", 1], ["azimuth [deg]", "azimuth_deg", 1]
  ];
  function row(cells, tag = "td") {
    const line = document.createElement("tr");
    line.append(...cells.map((text) => Object.assign(document.createElement(tag), {textContent: text})));
    return line;
  }
  function fillCascades() {
    const cascades = data.truth.filter((p) => p.name !== "ph");
    const truth = cascades.length === 1 ? cascades[0] : null;
    if (!cascades.length && !data.fits.length && !data.fit_status) return;
    element("cascade-panel").hidden = false;
    const table = element("cascades"), said = [];
    if (truth || data.fits.length) {
      element("cascade-title").textContent = truth ?
          (truth.length > 0 ? `Muon segment, ${fixed(truth.length, 0)} m` : `Cascade (${truth.name})`) :
          "Cascade";
      const head = document.createElement("thead");
      head.append(row(["", ...(truth ? ["truth"] : []), ...data.fits.map((fit) => fit.name)], "th"));
      const body = document.createElement("tbody");
      const withError = (fit, i, text, digits) =>
          fit.errors.length ? `${text} ± ${fixed(fit.errors[i], digits)}` : text;
      quantities.forEach(([name, key, digits], i) => body.append(row([
        name, ...(truth ? [fixed(truth[key], digits)] : []),
        ...data.fits.map((fit) => withError(fit, i, fixed(fit[key], digits), digits))
      ])));
      const digits = (gev) => Math.max(0, 3 - Math.floor(Math.log10(gev)));
      body.append(row([
        "energy [GeV]", ...(truth ? [String(+truth.energy.toPrecision(5))] : []),
        ...data.fits.map(
            (fit) => withError(
                fit, 6,
                fit.energy >= 1e6 ? fit.energy.toExponential(3).replace("e+", "e") :
                                    fixed(fit.energy, digits(fit.energy)),
                digits(fit.energy)))
      ]));
      table.replaceChildren(head, body);
      if (truth && !(truth.length > 0))
        for (const fit of data.fits) {
          const apart = Math.hypot(fit.x - truth.x, fit.y - truth.y, fit.z - truth.z);
          const cosine = travel(fit).reduce((sum, c, i) => sum + c * travel(truth)[i], 0);
          said.push(`${fit.name}: vertex ${fixed(apart, 1)} m and direction ${
              fixed(
                  Math.acos(Math.min(1, cosine)) / degree,
                  1)} deg from the truth, energy ${fixed(100 * (fit.energy / truth.energy - 1), 1)}% off.`);
        }
    } else if (cascades.length) {
      element("cascade-title").textContent = `${cascades.length} particles`;
      const head = document.createElement("thead"), body = document.createElement("tbody");
      head.append(row(["", "energy", "z [m]", "t [ns]"], "th"));
      for (const p of cascades.slice().sort((a, b) => b.energy - a.energy).slice(0, 12))
        body.append(row([p.name, energy(p.energy), fixed(p.z, 1), fixed(p.time, 0)]));
      table.replaceChildren(head, body);
      if (cascades.length > 12) said.push("The 12 of most energy are listed.");
    } else
      element("cascade-title").textContent = "Cascade";
    if (data.fit_status && !data.fits.length) said.push(`No fit: ${data.fit_status}.`);
    element("cascade-text").textContent = said.join(" ");
  }

  // ---- Ice

  function drawIce() {
    if (!data.ice) return;
    element("ice-panel").hidden = false;
    element("ice-title").textContent = `Ice: ${data.ice.name}`;
    element("ice-caption").textContent =
        `Absorption, the dust and the ice itself (shaded), and effective scattering (line) at 400 nm; flow towards azimuth ${
            fixed(data.ice.flow_azimuth_deg, 0)} deg.`;
    const {pen, width, height} = penOf(element("ice"));
    const depths = data.ice.z.map((z) => originDepth - z), deepest = Math.max(...depths),
          shallowest = Math.min(...depths);
    const values = data.ice.absorption.concat(data.ice.scattering).map(Math.log10);
    const low = Math.floor(Math.min(...values)), high = Math.ceil(Math.max(...values) * 2) / 2;
    const frame = {left: 52, right: width - 10, top: 8, bottom: height - 36};
    const x = (v) => frame.left + (Math.log10(v) - low) / (high - low) * (frame.right - frame.left);
    const {y} = axes(pen, frame, [NaN, NaN], [deepest, shallowest], "coefficient [1/m]", "depth [m]");
    pen.textAlign = "center";
    pen.textBaseline = "top";
    pen.fillStyle = css("--faint");
    for (let k = low; k <= high; ++k)
      pen.fillText(String(+(10 ** k).toPrecision(1)), x(10 ** k), frame.bottom + 6);
    pen.fillStyle = css("--dust");
    data.ice.absorption.forEach((a, i) => {
      const half = data.ice.step / 2;
      pen.fillRect(
          frame.left, y(depths[i] - half), x(a) - frame.left,
          y(depths[i] + half) - y(depths[i] - half) + 0.7);
    });
    pen.strokeStyle = css("--flow");
    pen.lineWidth = 1.6;
    pen.beginPath();
    data.ice.scattering.forEach((b, i) => pen.lineTo(x(b), y(depths[i])));
    pen.stroke();
  }

  // ---- Time

  const timeline = element("timeline");
  const shown = () => ({from: Math.max(window_.from, span.low), to: Math.min(window_.to, span.high)});
  const timeAt = (px) => span.low + (px - 8) / (timeline.clientWidth - 16) * (span.high - span.low);
  const pixelOf = (t) => 8 + (t - span.low) / (span.high - span.low) * (timeline.clientWidth - 16);

  function drawTimeline() {
    const {pen, width, height} = penOf(timeline);
    const bottom = height - 18,
          columns = Math.max(1, Math.floor(Math.min((width - 16) / 3, (span.high - span.low) / binWidth))),
          light = new Float64Array(columns);
    const step = (span.high - span.low) / columns;
    allBins.forEach((t, i) => {
      const k = Math.floor((t - span.low) / step);
      if (k >= 0 && k < columns) light[k] += allCharges[i];
    });
    const most = Math.sqrt(Math.max(1e-12, ...light)), {from, to} = shown();
    light.forEach((q, k) => {
      if (!q) return;
      const t = span.low + (k + 0.5) * step, tall = Math.max(1.5, Math.sqrt(q) / most * (bottom - 4));
      pen.fillStyle = rgb(colourAt(shadeOf(t) / (shades - 1)), t >= from && t <= to ? 1 : 0.25);
      const wide = Math.max((width - 16) / columns - 0.6, 1);
      pen.fillRect(pixelOf(t) - wide / 2, bottom - tall, wide, tall);
    });
    pen.strokeStyle = css("--edge");
    pen.beginPath();
    pen.moveTo(8, bottom + 0.5);
    pen.lineTo(width - 8, bottom + 0.5);
    pen.stroke();
    pen.fillStyle = css("--faint");
    pen.textAlign = "center";
    pen.textBaseline = "top";
    for (const t of ticks(span.low, span.high, Math.max(2, width / 130)))
      if (pixelOf(t) > 20 && pixelOf(t) < width - 30) pen.fillText(`${t} ns`, pixelOf(t), bottom + 4);
    pen.fillStyle = css("--accent");
    for (const t of [from, to]) {
      pen.fillRect(pixelOf(t) - 1.5, 0, 3, bottom);
      pen.beginPath();
      pen.arc(pixelOf(t), bottom / 2, 5, 0, 2 * Math.PI);
      pen.fill();
    }
    sayWindow();
  }

  function sayWindow() {
    let q = 0, modules = 0;
    for (const curve of data.curves) {
      const light = lightBetween(curve, window_.from, window_.to).charge;
      if (light > 0) {
        q += light;
        ++modules;
      }
    }
    const whole = window_.from === -Infinity && window_.to === Infinity;
    const from = window_.from === -Infinity ? data.time.begin : window_.from,
          to = window_.to === Infinity ? data.time.end : window_.to;
    const words = whole ? "all times" : `${fixed(from, 0)} to ${fixed(to, 0)} ns`;
    const small = document.createElement("small");
    small.textContent = `${charge(q)} of ${charge(totalCharge)} pe, ${thousands(modules)} modules`;
    element("window").replaceChildren(words, small);
    timeline.setAttribute("aria-valuetext", words);
  }

  // Ends at the ends of the axis stand for all that was before or came after.
  function setWindow(from, to) {
    const least = (span.high - span.low) / 400;
    window_.from = from <= span.low ? -Infinity : Math.min(from, span.high - least);
    window_.to = to >= span.high ? Infinity : Math.max(to, Math.max(window_.from, span.low) + least);
    redraw();
  }
  function moveWindow(share) {
    const {from, to} = shown(), width = to - from, by = share * (span.high - span.low);
    const start = Math.min(Math.max(from + by, span.low), span.high - width);
    setWindow(start, start + width);
  }

  let grip = null;  // what the pointer holds of the time line: "from", "to" or "both"
  timeline.addEventListener("pointerdown", (e) => {
    stop();
    timeline.setPointerCapture(e.pointerId);
    const {from, to} = shown(), px = e.offsetX, a = Math.abs(px - pixelOf(from)),
                 b = Math.abs(px - pixelOf(to));
    const whole = window_.from === -Infinity && window_.to === Infinity;
    grip = {
      part: Math.min(a, b) < 12 || whole         ? (a < b ? "from" : "to") :
          px > pixelOf(from) && px < pixelOf(to) ? "both" :
          a < b                                  ? "from" :
                                                   "to",
      at: timeAt(px)
    };
    dragTime(e);
  });
  function dragTime(e) {
    if (!grip) return;
    const t = timeAt(e.offsetX), {from, to} = shown();
    if (grip.part === "from")
      setWindow(Math.min(t, to), to);
    else if (grip.part === "to")
      setWindow(from, Math.max(t, from));
    else {
      moveWindow((t - grip.at) / (span.high - span.low));
      grip.at = t;
    }
  }
  timeline.addEventListener("pointermove", dragTime);
  timeline.addEventListener("pointerup", () => {
    grip = null;
  });
  timeline.addEventListener("dblclick", () => setWindow(-Infinity, Infinity));

  // A window of all times grows from the beginning; another one moves on as it is.
  const playSeconds = 8;
  function play() {
    const {from, to} = shown(), grows = to - from > 0.95 * (span.high - span.low), width = to - from;
    playing = {start: performance.now(), grows, width, from: grows || to >= span.high ? span.low : from};
    element("play").textContent = "❚❚";
    requestAnimationFrame(step);
  }
  function step(now) {
    if (!playing) return;
    const way = (now - playing.start) / 1000 / playSeconds * (span.high - span.low);
    if (playing.grows)
      setWindow(-Infinity, span.low + way);
    else
      setWindow(playing.from + way, Math.min(playing.from + way + playing.width, span.high - 1e-9));
    if ((playing.grows ? span.low : playing.from + playing.width) + way >= span.high) {
      if (playing.grows) setWindow(-Infinity, Infinity);
      stop();
    } else
      requestAnimationFrame(step);
  }
  function stop() {
    playing = null;
    element("play").textContent = "▶";
  }
  element("play").addEventListener("click", () => (playing ? stop() : play()));

  // ---- Mouse, fingers, keys

  function turn(yaw, pitch) {
    camera.lens = 1;
    camera.yaw += yaw;
    camera.pitch = Math.min(Math.max(camera.pitch + pitch, -89.9 * degree), 89.9 * degree);
    redraw();
  }
  function zoom(factor) {
    camera.distance = Math.min(Math.max(camera.distance * factor, 0.05 * reach), 8 * reach);
    redraw();
  }
  function pan(px, py) {
    const scale = project(...camera.target)?.scale ?? 1, sy = Math.sin(camera.yaw), cy = Math.cos(camera.yaw),
          sp = Math.sin(camera.pitch), cp = Math.cos(camera.pitch);
    const a = -px / scale, b = py / scale;
    camera.target[0] += -sy * a - sp * cy * b;
    camera.target[1] += cy * a - sp * sy * b;
    camera.target[2] += cp * b;
    redraw();
  }

  // The module nearest to a pixel: a lit one whose sphere holds it, in front first, else any within 8 pixels.
  function moduleAt(px, py) {
    for (let k = placed.length - 1; k >= 0; --k)
      if (Math.hypot(placed[k].x - px, placed[k].y - py) <= Math.max(placed[k].radius, 5))
        return placed[k].module;
    let best = -1, near = 8;
    for (let i = 0; i < moduleCount; ++i) {
      const p = project(detector.x[i], detector.y[i], detector.z[i]),
            d = p ? Math.hypot(p.x - px, p.y - py) : Infinity;
      if (d < near) {
        near = d;
        best = i;
      }
    }
    return best;
  }

  const fingers = new Map();
  let moved = 0;
  view.addEventListener("pointerdown", (e) => {
    view.setPointerCapture(e.pointerId);
    fingers.set(e.pointerId, [e.offsetX, e.offsetY]);
    if (fingers.size === 1) moved = 0;
  });
  view.addEventListener("pointermove", (e) => {
    const before = fingers.get(e.pointerId), now = [e.offsetX, e.offsetY];
    if (!before) return hover(...now);
    const dx = now[0] - before[0], dy = now[1] - before[1];
    moved += Math.abs(dx) + Math.abs(dy);
    if (fingers.size === 2) {
      const other = [...fingers].find(([id]) => id !== e.pointerId)[1];
      const was = Math.hypot(before[0] - other[0], before[1] - other[1]), is = Math.hypot(now[0] - other[0], now[1] - other[1]);
      if (was > 0 && is > 0) zoom(was / is);
      pan(dx / 2, dy / 2);
    } else if (e.shiftKey || e.buttons & 6)
      pan(dx, dy);
    else
      turn(-0.006 * dx, 0.006 * dy);
    fingers.set(e.pointerId, now);
  });
  for (const name of ["pointerup", "pointercancel"])
    view.addEventListener(name, (e) => {
      fingers.delete(e.pointerId);
      if (name === "pointerup" && moved < 5 && e.button === 0) select(moduleAt(e.offsetX, e.offsetY));
    });
  view.addEventListener("pointerleave", () => {
    hovered = -1;
    element("tip").hidden = true;
    redraw();
  });
  view.addEventListener("contextmenu", (e) => e.preventDefault());
  view.addEventListener("wheel", (e) => {
    e.preventDefault();
    zoom(Math.exp(0.0012 * Math.max(-400, Math.min(400, e.deltaY))));
  }, {passive: false});

  function hover(px, py) {
    const module = moduleAt(px, py), tip = element("tip");
    tip.hidden = module < 0;
    if (module >= 0) {
      const light = curveOf[module] && lightBetween(curveOf[module], window_.from, window_.to);
      tip.textContent = `${nameOf(module)}: ${
          light && light.charge > 0 ? `${charge(light.charge)} pe, from ${fixed(light.first, 0)} ns` :
                                      "no light"}`;
      tip.style.left = `${Math.min(px + 14, view.clientWidth - tip.offsetWidth - 4)}px`;
      tip.style.top = `${Math.max(py - 34, 4)}px`;
    }
    if (module !== hovered) {
      hovered = module;
      redraw();
    }
  }

  const home = () => {
    look(-60 * degree, 14 * degree);
    redraw();
  };
  // Near enough that the modules with most of the light fill the picture.
  function toEvent() {
    if (!byCharge.length) return;
    const weights = data.curves.map((curve) => Math.sqrt(curve.charge)),
          all = weights.reduce((a, b) => a + b, 0);
    const mean = (value) =>
        data.curves.reduce((sum, curve, i) => sum + weights[i] * value(curve.module), 0) / all;
    camera.target = ["x", "y", "z"].map((key) => mean((m) => detector[key][m]));
    const spread = Math.sqrt(mean(
        (m) => ["x", "y", "z"].reduce((sum, key, k) => sum + (detector[key][m] - camera.target[k]) ** 2, 0)));
    camera.distance = Math.min(Math.max(7.5 * spread, 0.25 * reach), 3 * reach);
    redraw();
  }
  const fromAbove = () => {
    look(-90 * degree, 89.9 * degree, 20);
    redraw();
  };
  const fromSide = () => {
    look(camera.yaw, 0, 20);
    redraw();
  };
  function toggleTheme() {
    const root = document.documentElement;
    root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
    drawIce();
    redraw();
  }
  function toggleHelp() {
    const help = element("help");
    help.hidden = !help.hidden;
    element("help-button").setAttribute("aria-expanded", String(!help.hidden));
  }
  const turnBy = 5 * degree;
  const keys = {
    ArrowLeft: (e) => (e.shiftKey ? pan(30, 0) : turn(-turnBy, 0)),
    ArrowRight: (e) => (e.shiftKey ? pan(-30, 0) : turn(turnBy, 0)),
    ArrowUp: (e) => (e.shiftKey ? pan(0, 30) : turn(0, turnBy)),
    ArrowDown: (e) => (e.shiftKey ? pan(0, -30) : turn(0, -turnBy)),
    "+": () => zoom(0.85),
    "=": () => zoom(0.85),
    "-": () => zoom(1 / 0.85),
    "0": home,
    e: toEvent,
    t: fromAbove,
    s: fromSide,
    d: toggleTheme,
    "?": toggleHelp,
    " ": () => (playing ? stop() : play()),
    "[": () => moveWindow(-0.02),
    "]": () => moveWindow(0.02),
    "{": () => setWindow(shown().from, shown().to - 0.02 * (span.high - span.low)),
    "}": () => setWindow(shown().from, shown().to + 0.02 * (span.high - span.low)),
    a: () => {
      stop();
      setWindow(-Infinity, Infinity);
    },
    n: () => selectNext(1),
    p: () => selectNext(-1),
    Escape: () => {
      select(-1);
      element("help").hidden = true;
    },
  };
  const explained = [
    ["drag, arrow keys", "turn"], ["shift + drag, shift + arrows", "move"], ["wheel, + and −", "zoom"],
    ["0, E", "whole detector, event"], ["T, S", "from above, from the side"], ["click", "select a module"],
    ["N, P", "next dimmer, next brighter module"], ["space", "play time"],
    ["[ and ]", "move the window of time"], ["{ and }", "move its end"], ["A", "all times"],
    ["D", "light or dark"], ["Esc", "select nothing"]
  ];
  document.addEventListener("keydown", (e) => {
    if (e.ctrlKey || e.altKey || e.metaKey) return;
    const act = keys[e.key] || keys[e.key.toLowerCase()];
    if (!act || (e.key === " " && e.target.tagName === "BUTTON")) return;
    e.preventDefault();
    act(e);
  });
  for (const [id, act] of [
           ["home", home], ["event", toEvent], ["top", fromAbove], ["side", fromSide], ["theme", toggleTheme],
           ["help-button", toggleHelp]])
    element(id).addEventListener("click", act);

  // ---- Begin

  // What a link may say after '#': module=63,20&time=0,800&zoom=event&yaw=30&pitch=10&theme=dark (degrees).
  function readLink() {
    const wish = new URLSearchParams(location.hash.slice(1));
    const dark = window.matchMedia("(prefers-color-scheme: dark)").matches;
    document.documentElement.dataset.theme = wish.get("theme") || (dark ? "dark" : "light");
    if (wish.has("yaw") || wish.has("pitch"))
      look(+(wish.get("yaw") ?? -60) * degree, +(wish.get("pitch") ?? 14) * degree);
    if (wish.get("zoom") === "event") toEvent();
    if (wish.has("time")) setWindow(...wish.get("time").split(",").map(Number));
    if (wish.has("module"))
      for (let i = 0; i < moduleCount; ++i)
        if (nameOf(i) === wish.get("module")) select(i);
  }

  function fillHeader() {
    element("title").textContent = `Event ${data.event}`;
    const words = [
      `${charge(totalCharge)} pe in ${thousands(data.hits)} ${data.hits === 1 ? "hit" : "hits"}`,
      `${thousands(data.curves.length)} of ${thousands(moduleCount)} modules`
    ];
    if (data.repeats !== 1) words.push(`average over ${+ data.repeats.toPrecision(4)} repetitions`);
    words.push(`detector ${detector.name}`, data.file);
    if (!data.all_waveforms) words.push("waveforms of the brightest modules only");
    element("summary").textContent = words.join(" · ");
  }
  function fillHelp() {
    const list = document.createElement("dl");
    for (const [key, what] of explained)
      list.append(
          Object.assign(document.createElement("dt"), {textContent: key}),
          Object.assign(document.createElement("dd"), {textContent: what}));
    element("help").replaceChildren(list);
  }

  if (byCharge.length) select(byCharge[0].module);
  readLink();
  fillHeader();
  fillHelp();
  fillLegend();
  fillCascades();
  drawIce();
  draw();
  // Drawn at once: a picture of the old size would be stretched until the next one.
  const resized = new ResizeObserver(() => {
    drawIce();
    draw();
  });
  for (const part of [view, timeline, element("ice"), element("curve")]) resized.observe(part);
  document.body.dataset.litModules = String(placed.length);  // of the first picture
  document.body.dataset.ready = "true";
})();
