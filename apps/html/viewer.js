// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The page of --html. Two models, before and after, are drawn with one camera into the two halves of a canvas.
//
// The triangles of a model stand in the order in which they go, those that stay first: what is left after any
// collapse is the first so many of them, drawn by one call. The vertex shader looks up where the vertex of each
// corner is: every vertex that has been removed is where that vertex is into which it has merged. A state
// between two collapses thus costs one pass over the vertices, from any other state, and nothing is kept
// between them.

import {
  BufferAttribute, BufferGeometry, DataTexture, DoubleSide, FloatType, LineBasicMaterial, LineSegments, Mesh, NearestFilter, PerspectiveCamera,
  RGBAFormat, Scene, ShaderMaterial, UnsignedByteType, Vector3, WebGLRenderer
} from 'three/build/three.module.js';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';

const $ = selector => document.querySelector(selector);
const number = n => n.toLocaleString('en');
const superscript = n => String(n).replace(/./g, c => '⁰¹²³⁴⁵⁶⁷⁸⁹'[c] || '⁻');
const figure = x => x === null || x === undefined ? '–' : x === 0 ? '0' : String(Number(x.toPrecision(3)));

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

// ── Data ──────────────────────────────────────────────────────────────────────────────────────────────────

const FROZEN = 1, LOCKED = 2, OFFENDING = 4; // flags of a face, as in html_report.cpp

async function unpacked(text) {
  const bytes = atob(text), packed = new Uint8Array(bytes.length);
  for (let i = 0; i < packed.length; ++i)
    packed[i] = bytes.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The numbers of a section: differences, folded so that small ones are small, byte by byte.
function numbers(block, [begin, count], List = Uint32Array) {
  const result = new List(count);
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
      value[key] = numbers(block, child, key === 'points' ? Uint16Array : Uint32Array);
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

const NEVER = 0xffffffff;

// For every triangle, the number of collapses after which it is gone. Two corners have merged when the ways of
// both, each from vertex to vertex by the collapses that remove them, have come together.
function last_steps(corners, nodes, {removed, kept}) {
  const time = new Uint32Array(nodes).fill(NEVER), target = new Uint32Array(nodes);
  for (let i = 0; i < removed.length; ++i)
    if (removed[i] !== kept[i]) {
      time[removed[i]] = i + 1;
      target[removed[i]] = kept[i];
    }
  const meeting = (a, b) => {
    let step = 0;
    while (a !== b) {
      if (time[a] > time[b])
        [a, b] = [b, a];
      step = time[a];
      if (step === NEVER)
        break;
      a = target[a];
    }
    return step;
  };
  const result = new Uint32Array(corners.length / 3);
  for (let t = 0; t < result.length; ++t) {
    const a = corners[3 * t], b = corners[3 * t + 1], c = corners[3 * t + 2];
    result[t] = Math.min(meeting(a, b), meeting(b, c), meeting(c, a));
  }
  return result;
}

class Model {
  // `place(steps, axis)` is where a coordinate is, and `pose(i)` has those of all nodes in a pose.
  constructor(mesh, place, pose) {
    this.mesh = mesh;
    this.place = place;
    this.pose = pose;
    this.nodes = mesh.points.length / 3;
    this.faces = mesh.corners.length / 3;
    this.home = new Float32Array(mesh.points.length);
    this.into = new Uint32Array(this.nodes);
    this.order = new Uint32Array(this.faces); // the face of each row
    this.last_step = new Uint32Array(this.faces); // of the face of each row: after it, the face is gone
    this.corners = new BufferAttribute(new Float32Array(mesh.corners.length), 1);
    this.texels = new BufferAttribute(new Float32Array(mesh.uv ? 2 * mesh.corners.length : 0), 2);
    const geometry = this.geometry = new BufferGeometry();
    geometry.setAttribute('position', this.corners);
    if (mesh.uv)
      geometry.setAttribute('texel', this.texels);
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
    this.put_into(0);
    this.follow(null);
    this.seek(0, null);
  }

  put_into(pose) {
    if (this.shown_pose === pose)
      return;
    this.shown_pose = pose;
    const points = pose === 0 ? this.mesh.points : this.pose(pose - 1);
    for (let i = 0; i < this.home.length; ++i)
      this.home[i] = this.place(points[i], i % 3);
  }

  // Makes ready to show the mesh after any of these collapses, and of no others.
  follow(collapses) {
    if (this.collapses === collapses)
      return;
    this.collapses = collapses;
    const {faces, mesh: {corners}} = this;
    const last_step = collapses ? last_steps(corners, this.nodes, collapses) : new Uint32Array(faces).fill(NEVER);
    // Counted by steps, of which there are no more than vertices.
    const steps = collapses ? collapses.removed.length : 0, begin = new Uint32Array(steps + 3);
    const rank = step => step === NEVER ? 0 : steps + 1 - step;
    for (const step of last_step)
      ++begin[rank(step) + 1];
    for (let i = 1; i < begin.length; ++i)
      begin[i] += begin[i - 1];
    for (let t = 0; t < faces; ++t) {
      const row = begin[rank(last_step[t])]++;
      this.order[row] = t;
      this.last_step[row] = last_step[t];
      for (let k = 0; k < 3; ++k)
        this.corners.array[3 * row + k] = corners[3 * t + k];
    }
    this.corners.needsUpdate = true;
    this.checked = -1;
  }

  // Shows the mesh after the first `step` collapses. `shares` has a number for every vertex of the original;
  // where several have merged, the largest is shown.
  seek(step, shares) {
    const {into, home, collapses} = this;
    for (let v = 0; v < into.length; ++v)
      into[v] = v;
    let points = home;
    if (collapses) {
      // A vertex merges into one that is removed later, if at all: backwards, that one is known already.
      const {removed, kept, placed, places} = collapses;
      for (let i = step - 1; i >= 0; --i)
        into[removed[i]] = into[kept[i]];
      // New places are places in the first pose; a reduction that makes them has no others.
      if (this.shown_pose === 0 && placed.length > 0 && placed[0] < step)
        points = home.slice();
      for (let k = 0; points !== home && k < placed.length && placed[k] < step; ++k)
        points.set(places.subarray(3 * k, 3 * k + 3), 3 * kept[placed[k]]);
    }
    this.points = points;
    const data = this.node_texture.image.data;
    for (let v = 0; v < into.length; ++v) {
      const from = 3 * into[v];
      data[4 * v] = points[from];
      data[4 * v + 1] = points[from + 1];
      data[4 * v + 2] = points[from + 2];
      data[4 * v + 3] = 0;
    }
    if (shares) {
      // Through the entry of the vertex that is left.
      for (let v = 0; v < into.length; ++v) {
        const at = 4 * into[v] + 3;
        data[at] = Math.max(data[at], shares[v] / 65535);
      }
      for (let v = 0; v < into.length; ++v)
        data[4 * v + 3] = data[4 * into[v] + 3];
    }
    this.node_texture.needsUpdate = true;
    this.step = step;
    let low = 0, high = this.faces; // The last steps descend.
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.last_step[middle] > step)
        low = middle + 1;
      else
        high = middle;
    }
    this.left = low;
    this.geometry.setDrawRange(0, 3 * low);
  }

  // The corners of a face as it is shown.
  corners_of(face) {
    return [0, 1, 2].map(k => new Vector3().fromArray(this.points, 3 * this.into[this.mesh.corners[3 * face + k]]));
  }

  // Gives every face a colour by `colour(face)`; null hides it.
  paint(colour) {
    const data = this.colour_texture.image.data;
    for (let row = 0; row < this.faces; ++row) {
      const c = colour(this.order[row]);
      data[4 * row + 3] = c ? 255 : 0;
      if (c) {
        data[4 * row] = c[0];
        data[4 * row + 1] = c[1];
        data[4 * row + 2] = c[2];
      }
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
      const row_in_result = new Uint32Array(this.faces);
      level.triangles.forEach((triangle, row) => row_in_result[triangle] = row);
      for (let row = 0; row < this.left; ++row)
        for (let k = 0; k < 3; ++k)
          put(3 * row + k, level.uv.reals, level.uv.corners[3 * row_in_result[this.order[row]] + k]);
    } else {
      uv.at_node = uv.at_node || values_at_nodes(this.mesh, this.nodes);
      for (let row = 0; row < this.left; ++row)
        for (let k = 0; k < 3; ++k) {
          const c = 3 * this.order[row] + k, node = this.into[corners[c]];
          let nearest = own[c], least = Infinity;
          if (node !== corners[c])
            for (const i of uv.at_node[node] || []) {
              const distance = (values[2 * i] - values[2 * own[c]]) ** 2 + (values[2 * i + 1] - values[2 * own[c] + 1]) ** 2;
              if (distance < least)
                [least, nearest] = [distance, i];
            }
          put(3 * row + k, values, nearest);
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
  constructor(report, scene, block) {
    this.report = report;
    this.data = scene;
    this.block = block;
    this.pose = 0; // that of the file; the others are numbered from 1
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
    // Poses are read when they are shown first.
    const model = mesh => new Model(mesh, this.box.place, pose => {
      if (mesh.poses.length === 0)
        return mesh.points;
      if (Array.isArray(mesh.poses[pose]))
        mesh.poses[pose] = numbers(this.block, mesh.poses[pose], Uint16Array);
      return mesh.poses[pose];
    });
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
    this.rings = document.querySelectorAll('.ring');
    this.camera = new PerspectiveCamera(32, 1, 0.001, 100);
    this.set_up(false);
    new ResizeObserver(() => this.resize()).observe($('#stage'));
    this.resize();
  }

  // The controls read which way is up when they are made.
  set_up(is_z_up) {
    if (this.controls)
      this.controls.dispose();
    this.camera.up.set(0, is_z_up ? 0 : 1, is_z_up ? 1 : 0);
    this.controls = new OrbitControls(this.camera, $('#canvas'));
    this.controls.zoomSpeed = 1.4;
    this.controls.addEventListener('change', () => this.request());
  }

  // Looks at the front from the right and from above, so that all is seen.
  reset_camera() {
    const [x, y, z] = this.data.extents, is_z_up = this.camera.up.z > 0;
    this.radius = Math.hypot(x, y, z) / 2 || 1;
    const across = Math.hypot(x, is_z_up ? y : z) / 2, height = (is_z_up ? z : y) / 2;
    const reach = Math.max(height, across / this.camera.aspect) / Math.tan(this.camera.fov / 2 * Math.PI / 180) + across;
    const from = is_z_up ? [0.55, -1, 0.3] : [0.55, 0.3, 1];
    this.camera.position.set(...from).setLength(1.05 * reach || 1);
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
    this.rings.forEach((ring, side) => {
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
    const exact = 'Every verdict is of the exact coordinates; the pictures have them rounded to 1/65,535 of the box around the meshes' +
      (data.poses.length > 0 ? ' in all poses.' : '.');
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
    $('#z_up').onchange = () => {
      this.set_up($('#z_up').checked);
      this.reset_camera();
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
    this.fill_poses();
    $('#slider').oninput = () => this.go_to_step(Number($('#slider').value));
    $('#play').onclick = () => this.play();
    this.make_plots();
    $('#before b').textContent = this.level ? 'Before' : path.replace(/.*[/\\]/, '');
    $('#after').hidden = $('#middle').hidden = !this.level;
    const open = report.terms ? report.terms.not_judged : [];
    $('#open').hidden = open.length === 0;
    $('#open').append(...open.map(({sentence}) => element('p', {className: 'soft', textContent: sentence})));
  }

  fill_levels() {
    const {levels, meshes} = this.data;
    $('#levels').hidden = levels.length < 2;
    const faces = meshes[0].corners.length / 3;
    levels.forEach(level => $('#levels .choices').append(level.button = element('button', {
      textContent: `${number(level.faces)} faces (${figure(100 * level.faces / faces)} %)`, title: level.name, onclick: () => this.show_level(level)
    })));
  }

  fill_verdict() {
    const {report} = this, of_level = this.report_of_level();
    let text, is_good;
    if (report.command === 'replay') {
      const verdicts = [report, ...report.poses], of_result = ({violations}) => violations.kinds.some(({kind}) => kind === 'result');
      const refused = verdicts.reduce((sum, verdict) => sum + verdict.violations.count - of_result(verdict), 0);
      is_good = report.exit_code !== 1;
      text = refused > 0 ? `${refused > 1 ? number(refused) + ' steps are' : 'A step is'} refused`
        : verdicts.some(of_result) ? 'The result is not what the log says'
        : report.exit_code !== 0 ? 'Interrupted: no step was refused until then' : 'Every step is accepted';
    } else {
      const {verified} = of_level, poses = [verified, ...verified.poses];
      const pairs = key => poses.reduce((sum, pose) => sum + pose[key], 0), added = pairs('new_pairs');
      text = verified.embedded ? 'No two faces touch or cross'
        : added === 0 ? `No new contact: the ${number(pairs('pairs'))} pairs that offend come from the input`
        : `${number(added)} pairs of faces touch or cross${verified.pairs_of_original === undefined ? '' : ' that did not before'}`;
      if (poses.length > 1)
        text += `, in ${number(poses.length)} poses`;
      const faults = [
        [report.options && !report.options.intersection_check, 'nothing kept layers apart (--no-intersection-check)'],
        [of_level.matching && !of_level.matching.complete, 'pieces do not match those of the original'],
        [report.layers && report.layers.swaps > 0, 'layers have changed places']
      ].filter(([is_so]) => is_so).map(([, what]) => what);
      is_good = added === 0 && faults.length === 0;
      text = [text, ...faults].join('; ');
    }
    $('#verdict').textContent = text;
    $('#verdict').classList.toggle('bad', !is_good);
  }

  // What the report says of the level that is shown.
  report_of_level() {
    return this.report.lods ? this.report.lods[this.data.levels.indexOf(this.level)] : this.report;
  }

  fill_facts() {
    const {report, level} = this, of_level = this.report_of_level();
    const facts = [['Faces', level ? `${number(this.models[0].faces)} → ${number(level.faces)}` : number(this.models[0].faces)]];
    if (of_level.target)
      facts.push(['Target', of_level.target.reached ? 'reached' : of_level.target.outcome === 'stopped' ? 'stopped' : 'not reached']);
    if (report.steps)
      facts.push(['Steps judged', number(report.steps.taken)], ['Limits', {log: 'those of the log', judge: 'the judge’s', none: 'none'}[report.terms.limits_of]],
        ['File', report.terms.input_bound ? 'the one that the log names' : 'NOT BOUND to the log'],
        ['Result', report.terms.result_bound ? 'the one that the log states' : 'NOT BOUND to the log']);
    const distance = of_level.distance;
    if (distance)
      facts.push(['Farthest off', `${figure(100 * Math.max(distance.original_to_result.max, distance.result_to_original.max))} % of size`],
        ['On average (RMS)', `${figure(100 * distance.original_to_result.rms)} % of size`]);
    if (report.frozen)
      facts.push(['Offending pairs before', number(report.frozen.pairs)]);
    if (of_level.pieces)
      facts.push(['Pieces', number(of_level.pieces.count)]);
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

  // The poses, and how many collapses the exact test refused in each.
  fill_poses() {
    const {poses} = this.data;
    $('#poses').hidden = poses.length === 0;
    ['as in the file', ...poses].forEach((name, pose) => {
      const button = element('button', {className: 'place', onclick: () => {
        this.stop();
        this.show_pose(pose);
      }}, element('span', {className: 'name', textContent: name, title: name}), element('span', {className: 'count'}));
      $('#poses .list').append(element('li', {}, button));
    });
    this.pose_buttons = document.querySelectorAll('#poses .place');
    $('#play_poses').onclick = () => this.play_poses();
  }

  count_refusals_in_poses() {
    const {refused, verified} = this.report_of_level();
    if (!refused || this.data.poses.length === 0)
      return;
    const counts = verified.poses.map(pose => pose.guarded ? pose.refused : null);
    counts.unshift(refused.intersection - counts.reduce((sum, count) => sum + count, 0));
    counts.forEach((count, pose) => {
      this.pose_buttons[pose].querySelector('.count').textContent = count === null ? 'result only' : number(count);
    });
    $('#poses .soft').textContent = 'Beside each pose: how many collapses the exact test refused in it. The first that refuses ends the question, and the pose of the file comes first.' +
      (counts.includes(null) ? ' In some poses only the result was judged, not each collapse.' : '');
  }

  fill_places() {
    const {levels, places, poses} = this.data;
    for (const id of ['#faults', '#places'])
      $(id).replaceChildren();
    for (const {heading, is_fault, count, list, pose, level} of places) {
      if (level !== null && levels[level] !== this.level)
        continue;
      const items = list.map(place => {
        const button = element('button', {className: 'place', textContent: place.text, title: place.text});
        button.onclick = () => {
          document.querySelectorAll('#faults .on, #places .on').forEach(other => other.classList.remove('on'));
          button.classList.add('on');
          this.stop();
          this.show_pose(pose);
          this.visit(place);
        };
        return element('li', {}, button);
      });
      if (count > list.length)
        items.push(element('li', {className: 'soft', textContent: `and ${number(count - list.length)} more`}));
      const title = pose > 0 ? `${heading}, in pose ${poses[pose - 1]}` : heading;
      $(is_fault ? '#faults' : '#places').append(element('h2', {textContent: title}), element('ul', {className: 'list'}, ...items));
    }
  }

  // ── Plots ──

  make_plots() {
    const plots = $('#plots');
    const seek = event => {
      const {left, width} = plots.getBoundingClientRect();
      const share = Math.min(1, Math.max(0, (event.clientX - left) / width));
      this.go_to_step(Math.round(share * this.level.steps));
    };
    plots.onpointerdown = seek;
    plots.onpointermove = event => event.buttons & 1 && seek(event);
  }

  fill_plots() {
    const history = this.level && this.level.history;
    const is_shown = Boolean(history && history.collapses.length > 1);
    $('#replay').classList.toggle('plotted', is_shown);
    if (!is_shown)
      return;
    const {collapses, least, largest, refused} = history;
    const steps = this.level.steps, x = collapses.map(count => 1000 * count / steps);
    const begin = [0, ...x.slice(0, -1)]; // of each sample
    // Costs are shown by their logarithms. Those of flat places are 0 or nearly so: six decades are enough.
    const most = Math.ceil(Math.log10(Math.max(...largest, 1e-300)));
    const lowest = Math.log10(least.reduce((a, cost) => cost > 0 ? Math.min(a, cost) : a, Infinity));
    const decades = Math.min(6, Math.max(1, most - Math.floor(lowest)));
    $('#decades').textContent = `10${superscript(most - decades)} to 10${superscript(most)}`;
    const y = cost => 100 * Math.min(1, (most - Math.log10(Math.max(cost, 1e-300))) / decades);
    const up = x.map((end, i) => `${begin[i]},${y(largest[i])} ${end},${y(largest[i])}`);
    const down = x.map((end, i) => `${end},${y(least[i])} ${begin[i]},${y(least[i])}`).reverse();
    $('#costs').replaceChildren(svg('polygon', {points: [...up, ...down].join(' '), fill: '#2d5bd7', stroke: '#2d5bd7'}));
    const last = ({counts}) => counts[counts.length - 1];
    refused.sort((a, b) => last(b) - last(a));
    const total = refused.length > 0 ? last(refused[0]) : 1;
    const colour = i => css(colour_of_number(i + 1));
    $('#refusals').replaceChildren(...refused.map(({counts}, i) => svg('polyline', {
      points: `0,100 ${counts.map((count, k) => `${x[k]},${100 - 100 * count / total}`).join(' ')}`, fill: 'none', stroke: colour(i)
    })));
    this.refusal_counts = refused.map(({rule, counts}, i) => {
      const count = element('span', {className: 'count'});
      return {counts, count, row: element('li', {title: rule}, swatch(colour(i)), element('span', {className: 'name', textContent: rule}), count)};
    });
    $('#refused').replaceChildren(...this.refusal_counts.map(({row}) => row));
  }

  // Says what the plots show at a step.
  mark_plots(step) {
    const {history, steps} = this.level;
    if (!$('#replay').classList.contains('plotted'))
      return;
    $('#marker').style.left = `${100 * step / steps}%`;
    const {collapses, least, largest} = history;
    const sample = collapses.findIndex(count => count >= step), i = sample < 0 ? collapses.length - 1 : sample;
    const cost = x => x === 0 ? '0' : x.toExponential(1);
    $('#cost').textContent = least[i] === largest[i] ? cost(largest[i]) : `${cost(least[i])} to ${cost(largest[i])}`;
    for (const {counts, count} of this.refusal_counts)
      count.textContent = number(step === 0 ? 0 : counts[i]);
  }

  // ── What is shown ──

  show_level(level) {
    this.stop();
    this.level = level;
    this.fill_verdict();
    this.fill_facts();
    this.fill_places();
    this.count_refusals_in_poses();
    for (const other of this.data.levels)
      other.button.classList.toggle('on', other === level);
    const is_replayed = level && level.collapses !== undefined && level.steps > 0;
    $('#replay').hidden = !is_replayed;
    this.fill_plots();
    this.resize();
    if (is_replayed) {
      $('#slider').max = level.steps;
      this.models[1].follow(this.data.collapses[level.collapses]);
    }
    this.steps_done = is_replayed ? level.steps : 0;
    this.show_pose(this.pose);
    this.show_mode(this.mode);
  }

  show_pose(pose) {
    this.pose = pose;
    this.pose_buttons.forEach((button, i) => button.classList.toggle('on', i === pose));
    for (const model of this.models)
      model.put_into(pose);
    const name = pose > 0 ? `, ${this.data.poses[pose - 1]}` : '';
    $('#before span').textContent = `${number(this.models[0].left)} faces${name}`;
    this.models[0].seek(0, this.level && this.level.distances);
    if (this.level)
      this.show_step(this.steps_done);
    if (this.obstacle) {
      this.obstacle.put_into(pose);
      this.obstacle.seek(0, null);
    }
    this.request();
  }

  show_step(step) {
    const {level} = this, [, after] = this.models;
    this.steps_done = step;
    after.seek(step, level.collapses === undefined ? level.distances_after : level.distances);
    const is_end = level.collapses === undefined || step === level.steps;
    if (level.collapses !== undefined) {
      $('#step').textContent = `${number(step)} of ${number(level.steps)} ${this.report.command === 'replay' ? 'steps' : 'collapses'}`;
      $('#slider').value = step;
      this.mark_plots(step);
    }
    $('#after b').textContent = is_end ? 'After' : 'On the way';
    $('#after span').textContent = `${number(after.left)} faces`;
    if (this.mode === 'checker')
      after.check(level);
    this.request();
  }

  // Shows a step at somebody's wish: what was playing ends.
  go_to_step(step) {
    this.stop();
    this.show_step(step);
  }

  // Calls `show(seconds)` for every picture until it returns false or something else is played.
  run(button, show) {
    this.stop();
    const start = performance.now();
    const playing = this.playing = now => {
      if (this.playing !== playing)
        return;
      if (show(Math.max(0, now - start) / 1000))
        requestAnimationFrame(playing);
      else
        this.stop();
    };
    this.play_button = button;
    button.textContent = 'Pause';
    requestAnimationFrame(playing);
  }

  stop() {
    this.playing = null;
    if (this.play_button)
      this.play_button.textContent = 'Play';
    this.play_button = null;
  }

  play() {
    if (this.play_button === $('#play'))
      return this.stop();
    const {steps} = this.level, from = this.steps_done % steps, seconds = 10;
    this.run($('#play'), now => {
      this.show_step(Math.min(steps, Math.round(from + now / seconds * steps)));
      return this.steps_done < steps;
    });
  }

  // All poses, again and again: a few of them slowly, the frames of a motion fast.
  play_poses() {
    if (this.play_button === $('#play_poses'))
      return this.stop();
    const count = this.data.poses.length + 1, per_second = count > 12 ? 12 : 2, from = this.pose;
    this.run($('#play_poses'), now => {
      const pose = (from + Math.floor(now * per_second)) % count;
      if (pose !== this.pose)
        this.show_pose(pose);
      return true;
    });
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
    const colour_of_reason = reason => reason < data.reasons.length ? colour_of_number(reason + 1) : FREE;
    const held = new Int16Array(this.models[0].faces).fill(-1);
    if (level && level.triangles)
      level.triangles.forEach((triangle, row) => held[triangle] = level.held_by.length ? level.held_by[row] : data.reasons.length);
    this.models.forEach(model => {
      const {mesh} = model, kind = mesh.kinds.find(other => other.kind === data.meshes[0].kinds[this.kind].kind);
      const names = data.meshes[0].kinds[this.kind];
      const by_name = kind && kind.kind !== 'piece' && mesh !== data.meshes[0] ? kind.names.map(name => names.names.indexOf(name)) : null;
      const part = t => !kind ? 0 : by_name ? by_name[kind.of_triangle[t]] : kind.of_triangle[t];
      const colours = Array.from({length: names.count}, (_, i) => colour_of_number(i));
      const colour = {
        part: t => colours[part(t)] || PLAIN,
        plain: () => PLAIN,
        distance: () => PLAIN,
        checker: t => colours[part(t)] || PLAIN,
        reason: t => held[t] < 0 ? GONE : colour_of_reason(held[t]),
        still: t => STILL.find(([flag]) => mesh.flags && mesh.flags[t] & flag || flag === 0)[1]
      }[mode];
      model.paint(hidden.size === 0 ? colour : t => hidden.has(part(t)) ? null : colour(t));
    });
    if (mode === 'reason') {
      const counts = new Map();
      for (const reason of held)
        counts.set(reason, (counts.get(reason) || 0) + 1);
      for (const [reason, count] of [...counts].sort((a, b) => b[1] - a[1]))
        if (reason >= 0)
          legend.push([colour_of_reason(reason), data.reasons[reason] || 'the target, which is reached', count]);
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

  // Shows a place in the list. That of a refused step is where the step begins, with its faces before and after.
  visit(place) {
    const [, after] = this.models, triangles = place.triangles || [];
    if (place.corners) {
      const corners = place.corners.map(corner => new Vector3(...corner.map((steps, axis) => this.box.place(steps, axis))));
      return this.fly(corners, []);
    }
    if (place.step === 0 || place.step > this.level.steps)
      return this.show_step(this.level.steps);
    this.show_step(place.step);
    const moved = triangles.flatMap(face => after.corners_of(face));
    this.show_step(place.step - 1);
    const {removed, kept} = this.data.collapses[this.level.collapses];
    const ends = [removed, kept].map(list => new Vector3().fromArray(after.points, 3 * after.into[list[place.step - 1]]));
    this.fly(triangles.length > 0 ? triangles.flatMap(face => after.corners_of(face)) : ends, moved);
  }

  // Comes near to a point or to triangles, and cuts away what is before them. Turns only to look straight at
  // a triangle. `moved` are triangles that are outlined, too.
  fly(corners, moved) {
    const least = corners.reduce((a, b) => a.clone().min(b)), most = corners.reduce((a, b) => a.clone().max(b));
    const target = this.marked = least.clone().add(most).multiplyScalar(0.5);
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    // A pair lies between layers as a rule: its outline is drawn over everything.
    this.outline = new Scene();
    for (const [shown, color] of [[moved, 0xf08c00], [corners, 0xd6218b]]) {
      const sides = shown.length > 2 ? shown.flatMap((corner, i) => [corner, shown[i % 3 < 2 ? i + 1 : i - 2]]) : shown.length === 2 ? shown : [];
      this.outline.add(new LineSegments(new BufferGeometry().setFromPoints(sides), new LineBasicMaterial({color, depthTest: false})));
    }
    if (corners.length > 2) {
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

const swatch = colour => element('span', {className: 'swatch', style: `background:${typeof colour === 'string' ? colour : css(colour)}`});

function svg(tag, attributes) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes))
    made.setAttribute(name, value);
  return made;
}
const STILL = [[OFFENDING, [214, 40, 57], 'in an offending pair'], [FROZEN, [52, 110, 196], 'frozen'],
  [LOCKED, [233, 164, 34], 'locked or kept, as asked'], [0, FREE, 'free to change']];

async function start() {
  const report = JSON.parse($('#report').textContent), scene = JSON.parse($('#scene').textContent);
  const block = await unpacked($('#block').textContent);
  for (const lists of [scene.meshes, scene.levels, scene.collapses])
    read(lists, block);
  window.viewer = new Viewer(report, scene, block);
}

start().catch(error => {
  console.error(error);
  $('#stage').append(element('div', {id: 'failed', textContent: `This page cannot show the meshes: ${error.message}.`}));
});
