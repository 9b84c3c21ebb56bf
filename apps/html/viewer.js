// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The page of --html. Two models, before and after, are drawn with one camera into the two halves of a canvas.
//
// A model never changes its triangles. The vertex shader looks up where the vertex of each corner is: every
// vertex that has been removed is where that vertex is into which it has merged, so that triangles which are
// gone have no area. A state between two collapses thus costs one pass over the vertices, from any other
// state, and nothing is kept between them.

import {
  BufferAttribute, BufferGeometry, DataTexture, DoubleSide, FloatType, LineBasicMaterial, LineSegments, Mesh, NearestFilter, PerspectiveCamera,
  RGBAFormat, Scene, ShaderMaterial, UnsignedByteType, Vector3, WebGLRenderer
} from 'three/build/three.module.js';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';

const $ = selector => document.querySelector(selector);
const number = n => n.toLocaleString('en');
const figure = x => x === null || x === undefined ? '–' : x === 0 ? '0' : String(Number(x.toPrecision(3)));

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

// ── Data ──────────────────────────────────────────────────────────────────────────────────────────────────

const FROZEN = 1, LOCKED = 2, OFFENDING = 4; // flags of a face, as in html_report.cpp

async function unpacked(text) {
  const packed = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The numbers of a section: differences, folded so that small ones are small, byte by byte.
function numbers(block, [begin, count]) {
  const result = new Uint32Array(count);
  for (let i = 0, at = begin, value = 0; i < count; ++i, ++at) {
    const folded = block[at] | block[at + count] << 8 | block[at + 2 * count] << 16 | block[at + 3 * count] << 24;
    result[i] = value += folded >>> 1 ^ -(folded & 1);
  }
  return result;
}

// Replaces every section by its numbers; a section is a list of a place in the block and a length.
const sections = new Set(['points', 'corners', 'of_triangle', 'values', 'flags', 'removed', 'kept', 'placed', 'places',
  'triangles', 'held_by', 'distances', 'distances_after']);
function read(value, block) {
  for (const [key, child] of Object.entries(value))
    if (sections.has(key) && Array.isArray(child) && typeof child[0] === 'number')
      value[key] = numbers(block, child);
    else if (child && typeof child === 'object')
      read(child, block);
}

// ── Colours ───────────────────────────────────────────────────────────────────────────────────────────────

const HUES = [[92, 136, 184], [238, 155, 82], [111, 176, 138], [222, 108, 106], [226, 196, 98], [158, 133, 190], [122, 190, 196],
  [240, 165, 178], [160, 130, 108], [166, 186, 96], [146, 154, 170]];

// After the last of these hues they return, paler.
function colour_of_number(i) {
  const pale = Math.floor(i / HUES.length) % 3 * 0.25;
  return HUES[i % HUES.length].map(x => Math.round(x + (245 - x) * pale));
}
const css = colour => `rgb(${colour})`;
const PLAIN = [201, 205, 212], GONE = [228, 230, 234], FREE = [201, 205, 212];
const RAMP = [[226, 228, 224], [246, 211, 101], [238, 131, 66], [197, 45, 76], [84, 24, 84]];

// ── Models ────────────────────────────────────────────────────────────────────────────────────────────────

const WIDTH = 2048; // of textures that are lists

function list_texture(count, type) {
  const height = Math.max(1, Math.ceil(count / WIDTH));
  const data = type === FloatType ? new Float32Array(4 * WIDTH * height) : new Uint8Array(4 * WIDTH * height);
  const texture = new DataTexture(data, WIDTH, height, RGBAFormat, type);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.generateMipmaps = false;
  texture.needsUpdate = true;
  return texture;
}

const vertex_shader = `
  uniform sampler2D nodes;
  uniform sampler2D colours;
  attribute vec2 texel;
  varying vec3 seen;
  varying vec3 inside;
  varying vec2 at;
  varying float share;
  flat varying vec3 colour;
  vec4 entry(sampler2D list, int i) { return texelFetch(list, ivec2(i % ${WIDTH}, i / ${WIDTH}), 0); }
  void main() {
    vec4 face = entry(colours, gl_VertexID / 3);
    vec4 node = entry(nodes, int(position.x + 0.5));
    vec4 place = modelViewMatrix * vec4(node.xyz, 1.0);
    int corner = gl_VertexID % 3;
    inside = vec3(corner == 0, corner == 1, corner == 2);
    seen = place.xyz;
    share = node.w;
    at = texel;
    colour = face.rgb;
    gl_Position = face.a > 0.0 ? projectionMatrix * place : vec4(2.0, 2.0, 2.0, 1.0);
  }`;

const fragment_shader = `
  uniform bool has_edges, is_by_share, is_checked;
  uniform float cut, opacity;
  varying vec3 seen;
  varying vec3 inside;
  varying vec2 at;
  varying float share;
  flat varying vec3 colour;
  vec3 ramp(float x) {
    vec3 c[5] = vec3[5](${RAMP.map(c => `vec3(${c.map(x => (x / 255).toFixed(4))})`)});
    float s = clamp(x, 0.0, 1.0) * 4.0;
    int i = min(int(s), 3);
    return mix(c[i], c[i + 1], s - float(i));
  }
  void main() {
    if (-seen.z < cut) discard;
    vec3 base = is_by_share ? ramp(sqrt(share)) : colour;
    if (is_checked) {
      vec2 square = floor(at);
      base = mod(square.x + square.y, 2.0) < 0.5 ? vec3(0.93) : base * vec3(0.62);
    }
    vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
    if (!gl_FrontFacing) base = mix(base, vec3(0.5, 0.52, 0.57), 0.4);
    float light = 0.56 + 0.36 * max(dot(normal, normalize(vec3(-0.45, 0.6, 0.66))), 0.0)
                + 0.2 * max(dot(normal, normalize(vec3(0.7, -0.1, 0.6))), 0.0);
    base *= light;
    if (has_edges) {
      vec3 width = fwidth(inside);
      vec3 far = smoothstep(width * 0.2, width * 1.1, inside);
      float line = 1.0 - min(min(far.x, far.y), far.z);
      float size = max(max(width.x, width.y), width.z); // of a pixel in the triangle
      base *= 1.0 - 0.52 * line * (1.0 - smoothstep(0.04, 0.36, size));
    }
    gl_FragColor = vec4(base, opacity);
  }`;

class Model {
  constructor(mesh, box, corners, texels) {
    this.mesh = mesh;
    this.nodes = mesh.points.length / 3;
    this.faces = mesh.corners.length / 3;
    this.home = new Float32Array(mesh.points.length);
    for (let i = 0; i < this.home.length; ++i)
      this.home[i] = box.place(mesh.points[i], i % 3);
    this.into = new Uint32Array(this.nodes);
    this.texels = texels;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', corners);
    geometry.setAttribute('texel', texels);
    this.node_texture = list_texture(this.nodes, FloatType);
    this.colour_texture = list_texture(this.faces, UnsignedByteType);
    this.uniforms = {
      nodes: {value: this.node_texture}, colours: {value: this.colour_texture}, has_edges: {value: true},
      is_by_share: {value: false}, is_checked: {value: false}, cut: {value: 0}, opacity: {value: 1}
    };
    const material = new ShaderMaterial({
      uniforms: this.uniforms, vertexShader: vertex_shader, fragmentShader: fragment_shader, side: DoubleSide
    });
    this.object = new Mesh(geometry, material);
    this.object.frustumCulled = false;
    this.scene = new Scene();
    this.scene.add(this.object);
    this.checked = -1;
    this.seek(null, 0, null);
  }

  // Shows the mesh after the first `step` collapses. `shares` has a number for every vertex of the original;
  // where several have merged, the largest is shown.
  seek(collapses, step, shares) {
    const {into, home} = this;
    for (let v = 0; v < into.length; ++v)
      into[v] = v;
    let points = home;
    if (collapses) {
      // A vertex merges into one that is removed later, if at all: backwards, that one is known already.
      const {removed, kept, placed, places} = collapses;
      for (let i = step - 1; i >= 0; --i)
        into[removed[i]] = into[kept[i]];
      if (placed.length > 0 && placed[0] < step)
        points = home.slice();
      for (let k = 0; k < placed.length && placed[k] < step; ++k)
        points.set(places.subarray(3 * k, 3 * k + 3), 3 * kept[placed[k]]);
    }
    const data = this.node_texture.image.data;
    for (let v = 0; v < into.length; ++v) {
      const from = 3 * into[v];
      data[4 * v] = points[from];
      data[4 * v + 1] = points[from + 1];
      data[4 * v + 2] = points[from + 2];
      data[4 * v + 3] = 0;
    }
    if (shares) {
      const largest = new Float32Array(into.length);
      for (let v = 0; v < into.length; ++v)
        largest[into[v]] = Math.max(largest[into[v]], shares[v] / 65535);
      for (let v = 0; v < into.length; ++v)
        data[4 * v + 3] = largest[into[v]];
    }
    this.node_texture.needsUpdate = true;
    this.step = step;
    const {corners} = this.mesh;
    this.left = 0;
    for (let c = 0; c < corners.length; c += 3) {
      const a = into[corners[c]], b = into[corners[c + 1]], d = into[corners[c + 2]];
      this.left += a !== b && b !== d && d !== a;
    }
  }

  // Gives every face a colour by `colour(face)`; null hides it.
  paint(colour) {
    const data = this.colour_texture.image.data;
    for (let t = 0; t < this.faces; ++t) {
      const c = colour(t);
      data[4 * t + 3] = c ? 255 : 0;
      if (c)
        data.set(c, 4 * t);
    }
    this.colour_texture.needsUpdate = true;
  }

  // Puts texture coordinates to the corners: those of the result where its triangles are shown. In between,
  // a corner has, of the values that its vertex has, the one nearest to its own.
  check(level) {
    const {uv, corners} = this.mesh;
    if (!uv || this.checked === this.step)
      return;
    this.checked = this.step;
    const own = uv.corners, values = uv.reals, scale = uv.scale, texels = this.texels.array;
    const put = (corner, reals, i) => {
      texels[2 * corner] = reals[2 * i] * scale;
      texels[2 * corner + 1] = reals[2 * i + 1] * scale;
    };
    if (level && level.uv && this.step === level.steps) {
      level.triangles.forEach((triangle, row) => {
        for (let k = 0; k < 3; ++k)
          put(3 * triangle + k, level.uv.reals, level.uv.corners[3 * row + k]);
      });
    } else {
      uv.at_node = uv.at_node || values_at_nodes(this.mesh, this.nodes);
      for (let c = 0; c < corners.length; ++c) {
        const node = this.into[corners[c]];
        let nearest = own[c], least = Infinity;
        if (node !== corners[c])
          for (const i of uv.at_node[node] || []) {
            const distance = (values[2 * i] - values[2 * own[c]]) ** 2 + (values[2 * i + 1] - values[2 * own[c] + 1]) ** 2;
            if (distance < least)
              [least, nearest] = [distance, i];
          }
        put(c, values, nearest);
      }
    }
    this.texels.needsUpdate = true;
  }
}

function values_at_nodes(mesh, count) {
  const lists = new Array(count);
  mesh.corners.forEach((node, c) => {
    const list = lists[node] || (lists[node] = []);
    if (!list.includes(mesh.uv.corners[c]))
      list.push(mesh.uv.corners[c]);
  });
  return lists;
}

// About 24 squares across the texture.
function prepare_uv(uv, scale) {
  uv.reals = Float32Array.from(uv.values, x => (x | 0) / 65536);
  const least = [Infinity, Infinity], most = [-Infinity, -Infinity];
  for (const i of uv.corners)
    for (let k = 0; k < 2; ++k) {
      least[k] = Math.min(least[k], uv.reals[2 * i + k]);
      most[k] = Math.max(most[k], uv.reals[2 * i + k]);
    }
  const span = Math.max(most[0] - least[0], most[1] - least[1]);
  uv.scale = scale || (span > 0 ? 48 / span : 1);
  return uv.scale;
}

// ── Page ──────────────────────────────────────────────────────────────────────────────────────────────────

class Viewer {
  constructor(report, scene) {
    this.report = report;
    this.data = scene;
    this.level = scene.levels[scene.levels.length - 1] || null;
    this.mode = 'part';
    this.kind = 0;
    this.hidden = new Set(); // "kind name"
    const extents = scene.extents;
    this.box = {place: (steps, axis) => (steps / 65535 - 0.5) * extents[axis]};
    for (const collapses of scene.collapses)
      collapses.places = Float32Array.from(collapses.places, (steps, i) => this.box.place(steps, i % 3));
    this.make_models();
    this.make_views();
    this.fill_panel();
    this.show_level(this.level);
    this.reset_camera();
  }

  make_models() {
    const {meshes, levels} = this.data;
    let scale = 0;
    for (const mesh of meshes)
      if (mesh.uv)
        scale = prepare_uv(mesh.uv, scale);
    for (const level of levels)
      if (level.uv)
        prepare_uv(level.uv, scale);
    const model = mesh => {
      mesh.corner_attribute = mesh.corner_attribute || new BufferAttribute(Float32Array.from(mesh.corners), 1);
      const texels = new BufferAttribute(new Float32Array(2 * mesh.corners.length), 2);
      return new Model(mesh, this.box, mesh.corner_attribute, texels);
    };
    this.models = [model(meshes[0])];
    if (this.level)
      this.models.push(model(meshes[this.level.mesh]));
    if (this.data.obstacle !== null) {
      this.obstacle = model(meshes[this.data.obstacle]);
      this.obstacle.paint(() => [168, 150, 138]);
    }
  }

  make_views() {
    const canvas = $('#canvas');
    const context = canvas.getContext('webgl2', {antialias: true, preserveDrawingBuffer: true});
    if (!context)
      throw new Error('this browser has no WebGL 2');
    this.renderer = new WebGLRenderer({canvas, context});
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setScissorTest(true);
    this.renderer.setClearColor(0xeef0f3);
    this.renderer.autoClear = false;
    this.camera = new PerspectiveCamera(32, 1, 0.001, 100);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomSpeed = 1.4;
    this.controls.addEventListener('change', () => this.request());
    new ResizeObserver(() => this.resize()).observe($('#stage'));
    this.resize();
  }

  reset_camera() {
    const radius = Math.hypot(...this.data.extents) / 2 || 1;
    this.radius = radius;
    this.camera.position.set(0.55, 0.3, 1).setLength(radius / Math.sin(16 * Math.PI / 180) * Math.max(1, 0.8 / this.camera.aspect));
    this.controls.target.set(0, 0, 0);
    this.controls.update();
    this.request();
  }

  resize() {
    const {clientWidth, clientHeight} = $('#stage');
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / this.models.length / Math.max(1, clientHeight);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  request() {
    if (!this.is_requested) {
      this.is_requested = true;
      requestAnimationFrame(() => {
        this.is_requested = false;
        this.draw();
      });
    }
  }

  draw() {
    const {clientWidth, clientHeight} = $('#stage'), width = clientWidth / this.models.length;
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = Math.max(distance / 1000, 1e-6);
    this.camera.far = distance + 4 * (this.radius || 1);
    this.camera.updateProjectionMatrix();
    const to_middle = this.camera.position.length(), reach = this.radius || 1;
    const cut = this.cut > 0 ? to_middle + (2 * this.cut - 1) * reach : 0;
    this.renderer.setScissor(0, 0, clientWidth, clientHeight);
    this.renderer.clear();
    this.models.forEach((model, side) => {
      this.renderer.setViewport(side * width, 0, width, clientHeight);
      this.renderer.setScissor(side * width, 0, width, clientHeight);
      for (const shown of [model, this.is_obstacle_shown !== false && this.obstacle])
        if (shown) {
          shown.uniforms.cut.value = cut;
          this.renderer.render(shown.scene, this.camera);
        }
      if (this.outline)
        this.renderer.render(this.outline, this.camera);
    });
    document.querySelectorAll('.ring').forEach((ring, side) => {
      ring.hidden = !this.marked || side >= this.models.length;
      if (ring.hidden)
        return;
      const at = this.marked.clone().project(this.camera);
      ring.hidden = Math.abs(at.x) > 1 || Math.abs(at.y) > 1;
      ring.style.left = side * width + (at.x + 1) / 2 * width + 'px';
      ring.style.top = (1 - at.y) / 2 * clientHeight + 'px';
    });
  }

  // ── The panel ──

  fill_panel() {
    const {report, data} = this;
    const path = (report.original || report.input).path;
    $('#name').textContent = path.replace(/.*[/\\]/, '') || path;
    document.title = $('#name').textContent + ' – Selvedge';
    $('#run').textContent = `selvedge ${report.command}, version ${report.version}`;
    const verified = report.verified;
    const is_good = report.exit_code !== 1 && (report.command !== 'verify' || report.exit_code === 0);
    $('#verdict').textContent = verified.embedded ? 'No two faces touch or cross'
      : verified.new_pairs === 0 ? `No new contact: the ${number(verified.pairs)} pairs that offend come from the input`
      : `${number(verified.new_pairs)} pairs of faces touch or cross${verified.pairs_of_original === undefined ? '' : ' that did not before'}`;
    $('#verdict').classList.toggle('bad', !is_good || verified.new_pairs > 0);
    const exact = 'Every verdict is of the exact coordinates; the pictures have them rounded to 1/65,535 of the box around the meshes.';
    $('#exact').textContent = exact;

    this.fill_levels();
    const modes = [['part', 'Parts'], ['plain', 'Plain'], ['distance', 'Distance'], ['reason', 'Held back by'],
      ['still', 'Frozen'], ['checker', 'Texture']];
    const has = {
      part: true, plain: true, distance: !!this.level, reason: data.levels.some(level => level.held_by && level.held_by.length),
      still: !!data.meshes[0].flags, checker: !!data.meshes[0].uv
    };
    for (const [mode, name] of modes)
      if (has[mode])
        $('#modes').append(element('button', {textContent: name, id: 'mode-' + mode, onclick: () => this.show_mode(mode)}));

    data.meshes[0].kinds.forEach((kind, i) => {
      const plural = {piece: 'Pieces', group: 'Groups', object: 'Objects', material: 'Materials'}[kind.kind];
      $('#kinds').append(element('option', {value: i, textContent: plural}));
    });
    $('#kinds').onchange = () => {
      this.kind = Number($('#kinds').value);
      this.hidden.clear();
      this.fill_parts();
      this.paint();
    };
    // Names say more than numbers, and pieces say more than one group that is all.
    const named = data.meshes[0].kinds.findIndex(kind => kind.kind !== 'piece' && kind.count > 1);
    this.kind = Math.max(0, named);
    $('#kinds').value = this.kind;
    for (const [id, is_hidden] of [['#all', false], ['#none', true]])
      $(id).onclick = () => {
        this.hidden.clear();
        if (is_hidden)
          for (let part = 0; part < data.meshes[0].kinds[this.kind].count; ++part)
            this.hidden.add(part);
        this.fill_parts();
        this.paint();
      };
    this.fill_parts();

    $('#edges').onchange = () => {
      for (const model of this.models)
        model.uniforms.has_edges.value = $('#edges').checked;
      this.request();
    };
    if (this.obstacle) {
      $('#obstacle').hidden = false;
      this.obstacle.uniforms.has_edges.value = false;
      $('#obstacle input').onchange = () => {
        this.is_obstacle_shown = $('#obstacle input').checked;
        this.request();
      };
    }
    $('#cut').oninput = () => {
      this.cut = Number($('#cut').value);
      this.request();
    };
    this.fill_places();
    $('#slider').oninput = () => this.show_step(Number($('#slider').value));
    $('#play').onclick = () => this.play();
    $('#before b').textContent = this.level ? 'Before' : path.replace(/.*[/\\]/, '');
    $('#before span').textContent = `${number(this.models[0].faces)} faces`;
    $('#after').hidden = $('#middle').hidden = !this.level;
  }

  fill_levels() {
    const {levels} = this.data;
    $('#levels').hidden = levels.length < 2;
    levels.forEach(level => $('#levels .choices').append(level.button = element('button', {
      textContent: `${number(level.faces)} faces`, title: level.name, onclick: () => this.show_level(level)
    })));
  }

  fill_facts() {
    const {report, level} = this;
    const of_level = report.lods ? report.lods[this.data.levels.indexOf(level)] : report;
    const facts = [['Faces', level ? `${number(this.models[0].faces)} → ${number(level.faces)}` : number(this.models[0].faces)]];
    if (of_level.target)
      facts.push(['Target', of_level.target.reached ? 'reached' : of_level.target.outcome === 'stopped' ? 'stopped' : 'not reached']);
    const distance = of_level.distance;
    if (distance)
      facts.push(['Farthest off', `${figure(100 * Math.max(distance.original_to_result.max, distance.result_to_original.max))} % of size`],
        ['On average (RMS)', `${figure(100 * distance.original_to_result.rms)} % of size`]);
    if (report.frozen)
      facts.push(['Offending pairs before', number(report.frozen.pairs)]);
    facts.push(['Pieces', number((of_level.pieces || report.pieces).count)]);
    if (report.seconds && report.seconds.reduce)
      facts.push(['Reduced in', `${figure(report.seconds.reduce)} s`]);
    $('#facts').replaceChildren(...facts.flatMap(([name, value]) => [element('dt', {textContent: name}), element('dd', {textContent: value})]));
  }

  fill_parts() {
    const most = 200, kind = this.data.meshes[0].kinds[this.kind];
    const counts = new Uint32Array(kind.count);
    for (const part of kind.of_triangle)
      ++counts[part];
    const order = Array.from(counts.keys()).filter(part => counts[part] > 0).sort((a, b) => counts[b] - counts[a]);
    $('#parts').replaceChildren(...order.slice(0, most).map(part => {
      const box = element('input', {type: 'checkbox', checked: !this.hidden.has(part)});
      box.onchange = () => {
        box.checked ? this.hidden.delete(part) : this.hidden.add(part);
        this.paint();
      };
      const name = kind.kind === 'piece' ? `Piece ${part + 1}` : kind.names[part] || '(no name)';
      return element('li', {}, element('label', {className: 'row', style: 'flex:1;min-width:0', title: name}, box, swatch(colour_of_number(part)),
        element('span', {className: 'name', textContent: name}), element('span', {className: 'count', textContent: number(counts[part])})));
    }));
    if (order.length > most)
      $('#parts').append(element('li', {className: 'soft', textContent: `and ${number(order.length - most)} smaller ones`}));
  }

  fill_places() {
    for (const {heading, count, list, is_after} of this.data.places) {
      const items = list.map(place => {
        const button = element('button', {className: 'place', textContent: place.text});
        button.onclick = () => {
          document.querySelectorAll('.place.on').forEach(other => other.classList.remove('on'));
          button.classList.add('on');
          this.fly(place);
        };
        return element('li', {}, button);
      });
      if (count > list.length)
        items.push(element('li', {className: 'soft', textContent: `and ${number(count - list.length)} more`}));
      $('#places').append(element('h2', {textContent: heading}), element('ul', {className: 'list'}, ...items));
    }
  }

  // ── What is shown ──

  show_level(level) {
    this.level = level;
    this.fill_facts();
    for (const other of this.data.levels)
      other.button.classList.toggle('on', other === level);
    const is_replayed = level && level.collapses !== undefined && level.steps > 0;
    $('#replay').hidden = !is_replayed;
    this.resize();
    if (is_replayed) {
      $('#slider').max = level.steps;
      $('#slider').value = level.steps;
    }
    if (level) {
      this.models[0].seek(null, 0, level.distances);
      this.show_step(is_replayed ? level.steps : 0);
    }
    this.show_mode(this.mode);
  }

  show_step(step) {
    const {level} = this, [, after] = this.models;
    if (level.collapses === undefined) {
      after.seek(null, 0, level.distances_after);
    } else {
      after.seek(this.data.collapses[level.collapses], step, level.distances);
      $('#step').textContent = `${number(step)} of ${number(level.steps)} collapses`;
      $('#slider').value = step;
    }
    const is_end = level.collapses === undefined || step === level.steps;
    $('#after b').textContent = is_end ? 'After' : 'On the way';
    $('#after span').textContent = `${number(after.left)} faces`;
    if (this.mode === 'checker')
      after.check(level);
    this.request();
  }

  play() {
    const {steps} = this.level, seconds = 10;
    if (this.playing) {
      this.playing = null;
    } else {
      const from = Number($('#slider').value) % steps, start = performance.now();
      const playing = this.playing = now => {
        if (this.playing !== playing)
          return;
        const step = Math.min(steps, Math.max(from, Math.round(from + (now - start) / 1000 / seconds * steps)));
        this.show_step(step);
        if (step < steps)
          requestAnimationFrame(playing);
        else
          this.stop();
      };
      requestAnimationFrame(playing);
    }
    $('#play').textContent = this.playing ? 'Pause' : 'Play';
  }

  stop() {
    this.playing = null;
    $('#play').textContent = 'Play';
  }

  show_mode(mode) {
    this.mode = mode;
    document.querySelectorAll('#modes button').forEach(button => button.classList.toggle('on', button.id === 'mode-' + mode));
    for (const model of this.models) {
      model.uniforms.is_by_share.value = mode === 'distance';
      model.uniforms.is_checked.value = mode === 'checker';
    }
    if (mode === 'checker')
      this.models.forEach((model, side) => model.check(side ? this.level : null));
    this.paint();
  }

  paint() {
    const {data, level, mode, hidden} = this;
    const legend = [];
    const held = new Int16Array(this.models[0].faces).fill(-1);
    if (level && level.triangles)
      level.triangles.forEach((triangle, row) => held[triangle] = level.held_by.length ? level.held_by[row] : data.reasons.length);
    this.models.forEach(model => {
      const {mesh} = model, kind = mesh.kinds.find(other => other.kind === data.meshes[0].kinds[this.kind].kind);
      const names = data.meshes[0].kinds[this.kind];
      const by_name = kind && kind.kind !== 'piece' && mesh !== data.meshes[0] ? kind.names.map(name => names.names.indexOf(name)) : null;
      const part = t => !kind ? 0 : by_name ? by_name[kind.of_triangle[t]] : kind.of_triangle[t];
      const colours = new Map();
      const of_part = i => colours.get(i) || colours.set(i, i < 0 ? PLAIN : colour_of_number(i)).get(i);
      const colour = {
        part: t => of_part(part(t)),
        plain: () => PLAIN,
        distance: () => PLAIN,
        checker: t => of_part(part(t)),
        reason: t => held[t] < 0 ? GONE : REASONS[held[t]] || FREE,
        still: t => STILL.find(([flag]) => mesh.flags && mesh.flags[t] & flag || flag === 0)[1]
      }[mode];
      model.paint(t => hidden.has(part(t)) ? null : colour(t));
    });
    if (mode === 'reason') {
      const counts = new Map();
      for (const reason of held)
        counts.set(reason, (counts.get(reason) || 0) + 1);
      for (const [reason, count] of [...counts].sort((a, b) => b[1] - a[1]))
        if (reason >= 0)
          legend.push([REASONS[reason] || FREE, data.reasons[reason] || 'the target, which is reached', count]);
      if (counts.has(-1))
        legend.push([GONE, 'gone in the result', counts.get(-1)]);
    } else if (mode === 'still') {
      const {flags} = data.meshes[0];
      for (const [flag, colour, name] of STILL) {
        const count = flags.filter(f => flag ? f & flag : f === 0).length;
        if (count > 0)
          legend.push([colour, name, count]);
      }
    }
    const rows = legend.map(([colour, name, count]) => element('li', {title: name}, swatch(colour),
      element('span', {className: 'name', textContent: name}), element('span', {className: 'count', textContent: number(count)})));
    $('#legend').replaceChildren(element('ul', {}, ...rows));
    const explained = {
      distance: 'How far each vertex of the original is from the surface of the result, in the unit of the file. A vertex of the result shows the largest distance of those that have merged into it.',
      reason: 'What would have to give way first for the face to go.',
      checker: 'The texture as squares. Between the first and the last step, it is approximate.'
    }[mode];
    if (mode === 'distance') {
      const bar = element('div', {id: 'scale'});
      // The root of the distance is shown, so that small ones can be told apart.
      bar.style.background = `linear-gradient(90deg, ${RAMP.map(css)})`;
      $('#legend').replaceChildren(bar, element('div', {className: 'ends'}, element('span', {textContent: '0'}),
        element('span', {textContent: figure(level.largest / 4)}), element('span', {textContent: `${figure(level.largest)}`})));
    }
    if (explained)
      $('#legend').append(element('p', {className: 'soft', textContent: explained}));
    this.request();
  }

  // Comes near to a place, and cuts away what is before it. Turns only to look straight at a triangle.
  fly(place) {
    const corners = place.corners.map(corner => new Vector3(...corner.map((steps, axis) => this.box.place(steps, axis))));
    const least = corners.reduce((a, b) => a.clone().min(b)), most = corners.reduce((a, b) => a.clone().max(b));
    const target = this.marked = least.clone().add(most).multiplyScalar(0.5);
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    // A pair lies between layers as a rule: its outline is drawn over everything.
    const sides = corners.length > 1 ? corners.flatMap((corner, i) => [corner, corners[i % 3 < 2 ? i + 1 : i - 2]]) : [];
    this.outline = new Scene();
    this.outline.add(new LineSegments(new BufferGeometry().setFromPoints(sides), new LineBasicMaterial({color: 0xd6218b, depthTest: false})));
    if (corners.length > 1) {
      const [a, b, c] = corners, normal = b.clone().sub(a).cross(c.clone().sub(a));
      if (normal.length() > 0)
        direction.copy(normal.normalize().multiplyScalar(normal.dot(direction) < 0 ? -1 : 1));
    }
    const room = Math.max(most.distanceTo(least), 0.02 * this.radius);
    const position = target.clone().addScaledVector(direction, 10 * room);
    const from = {position: this.camera.position.clone(), target: this.controls.target.clone()}, start = performance.now();
    const flight = this.flight = now => {
      if (this.flight !== flight)
        return;
      const share = Math.min(1, Math.max(0, (now - start) / 500)), eased = share * share * (3 - 2 * share);
      this.camera.position.lerpVectors(from.position, position, eased);
      this.controls.target.lerpVectors(from.target, target, eased);
      this.controls.update();
      const depth = this.camera.position.distanceTo(target) - room;
      $('#cut').value = this.cut = (1 + (depth - this.camera.position.length()) / this.radius) / 2;
      this.request();
      if (share < 1)
        requestAnimationFrame(flight);
    };
    requestAnimationFrame(flight);
  }
}

const swatch = colour => element('span', {className: 'swatch', style: `background:${css(colour)}`});
const REASONS = Array.from({length: 22}, (_, i) => colour_of_number(i + 1));
const STILL = [[OFFENDING, [214, 40, 57], 'in an offending pair'], [FROZEN, [52, 110, 196], 'frozen'],
  [LOCKED, [233, 164, 34], 'locked or kept, as asked'], [0, FREE, 'free to change']];

async function start() {
  const report = JSON.parse($('#report').textContent), scene = JSON.parse($('#scene').textContent);
  read(scene, await unpacked($('#block').textContent));
  window.viewer = new Viewer(report, scene);
}

start().catch(error => {
  console.error(error);
  $('#stage').append(element('div', {id: 'failed', textContent: `This page cannot show the meshes: ${error.message}.`}));
});
