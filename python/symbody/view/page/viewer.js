// The viewer: draws the scene that the page carries. Lengths are in the model's units; angles come as quaternions.
"use strict";
(() => {
  const scene = JSON.parse(document.getElementById("scene").textContent);
  const element = (id) => document.getElementById(id);
  const { center, radius, up, direction, floor, extremes } = scene.view;
  const thickness = scene.thickness;
  const times = scene.times, last = times.length - 1;
  const V = (a) => new THREE.Vector3(a[0], a[1], a[2]);

  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  } catch (error) {
    element("fault").hidden = false;
    element("fault").textContent = "This browser has no WebGL, which the animation needs.";
    return;
  }
  renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
  element("stage").appendChild(renderer.domElement);

  // --- world, light, camera ---
  const world = new THREE.Scene();
  world.background = new THREE.Color("#f4f6f8");
  const camera = new THREE.PerspectiveCamera(35, 1, radius / 100, radius * 100);
  camera.up.copy(V(up));
  const controls = new THREE.OrbitControls(camera, renderer.domElement);
  world.add(new THREE.AmbientLight(0xffffff, 0.9));
  const sun = new THREE.DirectionalLight(0xffffff, 2.2);
  world.add(sun, sun.target);

  const gone = new THREE.Vector3();   // how far the camera has gone with the body that it follows
  // As near as the outermost points allow, seen between the headline and the bar.
  function lookAtAll() {
    const height = Math.tan((camera.fov / 2) * Math.PI / 180), width = height * camera.aspect;
    const top = Math.min(0.25, 100 / window.innerHeight), bottom = Math.min(0.4, 165 / window.innerHeight);
    const back = V(direction), right = V(up).cross(back).normalize(), above = back.clone().cross(right);
    const points = extremes.map((p) => V(p).sub(V(center)));
    const x = points.map((p) => p.dot(right)), y = points.map((p) => p.dot(above)), z = points.map((p) => p.dot(back));
    const least = Math.max(...z) + 0.05 * radius;
    // How far right (or up) the camera must stand, and how far away, so that all lies between two planes through it.
    const fit = (u, low, high) => {
      let far = least;
      const lowest = (d) => Math.max(...u.map((v, k) => v - high * (d - z[k])));
      const highest = (d) => Math.min(...u.map((v, k) => v + low * (d - z[k])));
      for (let k = 0; k < 200 && lowest(far) > highest(far); k++) far += 0.02 * radius + 0.02 * far;
      return [far, (d) => (lowest(d) + highest(d)) / 2];
    };
    const [farX, atX] = fit(x, 0.9 * width, 0.9 * width);
    const [farY, atY] = fit(y, (1 - bottom) * height, (1 - top) * height);
    const far = Math.max(farX, farY);
    controls.target.copy(V(center)).add(gone).addScaledVector(right, atX(far)).addScaledVector(above, atY(far));
    camera.position.copy(controls.target).addScaledVector(back, far);
    controls.update();
  }

  function resize() {
    camera.aspect = window.innerWidth / window.innerHeight;
    camera.updateProjectionMatrix();
    renderer.setSize(window.innerWidth, window.innerHeight);
  }

  // --- things ---
  const followers = [];   // functions of (i, s): between instant i and the next
  const labels = [];

  const pose = (track, i, s, object) => {
    const a = 7 * i, b = 7 * Math.min(i + 1, last), p = scene.poses[track];
    object.position.set(p[a], p[a + 1], p[a + 2]).lerp(new THREE.Vector3(p[b], p[b + 1], p[b + 2]), s);
    object.quaternion.set(p[a + 3], p[a + 4], p[a + 5], p[a + 6])
      .slerp(new THREE.Quaternion(p[b + 3], p[b + 4], p[b + 5], p[b + 6]), s);
  };
  const at = (path, i, s) => {
    const a = 3 * i, b = 3 * Math.min(i + 1, last);
    return new THREE.Vector3(path[a], path[a + 1], path[a + 2])
      .lerp(new THREE.Vector3(path[b], path[b + 1], path[b + 2]), s);
  };
  const carried = (track) => {
    const group = new THREE.Group();
    world.add(group);
    followers.push((i, s) => pose(track, i, s, group));
    return group;
  };
  function label(text, place, color) {
    if (!text) return;
    const span = document.createElement("span");
    span.textContent = text;
    span.style.color = color;
    element("labels").appendChild(span);
    labels.push({ span, place });
  }

  const paint = (color) => new THREE.MeshStandardMaterial({ color, roughness: 0.6, metalness: 0.05 });
  function glass(color) {
    const material = paint(color);
    return Object.assign(material, { transparent: true, opacity: 0.45, depthWrite: false });
  }
  function rod(from, to, thickness, material) {
    const axis = V(to).sub(V(from)), length = axis.length();
    const mesh = new THREE.Mesh(new THREE.CylinderGeometry(thickness, thickness, length, 32), material);
    mesh.position.copy(V(from)).addScaledVector(axis, 0.5);
    if (length > 0) mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), axis.normalize());
    return mesh;
  }
  const solids = {
    box: (part, material) => new THREE.Mesh(new THREE.BoxGeometry(...part.size), material),
    ellipsoid(part, material) {
      const mesh = new THREE.Mesh(new THREE.SphereGeometry(1, 40, 24), material);
      mesh.scale.copy(V(part.size));
      return mesh;
    },
    rod: (part, material) => rod(part.from, part.to, part.radius, material),
    plate(part, material) {
      const shape = new THREE.Shape(part.corners.map(([x, y]) => new THREE.Vector2(x, y)));
      const mesh = new THREE.Mesh(
        new THREE.ExtrudeGeometry(shape, { depth: part.thickness, bevelEnabled: false }), material);
      mesh.position.z = part.z - part.thickness / 2;
      return mesh;
    },
  };
  // A diameter on each end of a rod shows its spin.
  function diameters(part) {
    const length = V(part.to).distanceTo(V(part.from)), r = part.radius, ends = [];
    for (const y of [-0.501 * length, 0.501 * length]) ends.push(r, y, 0, -r, y, 0);
    return new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(new Float32Array(ends), 3));
  }
  function solid(part, color) {
    const mesh = solids[part.kind](part, part.glass ? glass(color) : paint(color));
    if (part.at) mesh.position.copy(V(part.at));
    if (part.rotation) {
      const [[a, b, c], [d, e, f], [g, h, k]] = part.rotation;
      mesh.matrix.set(a, b, c, 0, d, e, f, 0, g, h, k, 0, 0, 0, 0, 1);
      mesh.quaternion.setFromRotationMatrix(mesh.matrix);
    }
    const dark = new THREE.LineBasicMaterial({ color: 0x1c2733, transparent: true, opacity: 0.45 });
    if (part.kind !== "ellipsoid") mesh.add(new THREE.LineSegments(new THREE.EdgesGeometry(mesh.geometry, 35), dark));
    if (part.kind === "rod") mesh.add(new THREE.LineSegments(diameters(part), dark));
    const group = carried(part.pose);
    group.add(mesh);
    return group;
  }

  function row(chip, text) {
    const line = document.createElement("div");
    line.append(chip, text);
    element("legend").appendChild(line);
    return line;
  }
  const chip = (text, color) => {
    const mark = document.createElement("i");
    mark.textContent = text;
    mark.style[text ? "color" : "background"] = color;
    return mark;
  };

  for (const body of scene.bodies) {
    const shown = body.parts.map((part) => solid(part, body.color));
    const group = carried(body.pose);
    if (body.is_named) label(body.name, () => group.position, "#1c2733");
    const line = row(chip("", body.color), body.name);
    line.title = "hide or show";
    line.style.cursor = "pointer";
    line.onclick = () => {
      shown.forEach((each) => { each.visible = !each.visible; });
      line.style.opacity = shown[0].visible ? 1 : 0.4;
    };
  }
  for (const link of scene.links) {
    const group = carried(link.pose), size = thickness / (link.thin ? 10 : 3.2);
    group.add(rod(link.from, link.to, size, paint(link.color)));
    if (link.thin) continue;
    for (const end of [link.from, link.to]) {
      const ball = new THREE.Mesh(new THREE.SphereGeometry(1.5 * size, 24, 16), paint("#44505c"));
      ball.position.copy(V(end));
      group.add(ball);
    }
  }
  for (const axes of scene.axes) {
    const group = carried(axes.pose), size = 0.22 * radius;
    [["x", 0xd62728, [1, 0, 0]], ["y", 0x2ca02c, [0, 1, 0]], ["z", 0x1f77b4, [0, 0, 1]]].forEach(([name, color, axis]) => {
      const arrow = new THREE.ArrowHelper(V(axis), new THREE.Vector3(), 1, color, 0.22, 0.1);
      group.add(new THREE.Group().add(arrow));
      arrow.parent.scale.setScalar(size);
      const tip = V(axis).multiplyScalar(1.12 * size);
      label(name, () => group.localToWorld(tip.clone()), "#" + color.toString(16).padStart(6, "0"));
    });
    if (axes.name && axes.name !== "ground") label(axes.name, () => group.position, "#1c2733");
  }
  for (const point of scene.points) {
    const ball = new THREE.Mesh(new THREE.SphereGeometry(0.014 * radius, 20, 14), paint("#1c2733"));
    world.add(ball);
    followers.push((i, s) => ball.position.copy(at(point.path, i, s)));
    label(point.name, () => ball.position, "#1c2733");
  }
  scene.traces.forEach((place, k) => {
    const geometry = new THREE.BufferGeometry(), path = scene.points[place].path;
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(path), 3));
    const color = ["#d6272a", "#9467bd", "#17becf", "#bcbd22"][k % 4];
    const faint = new THREE.LineBasicMaterial({ color, transparent: true, opacity: 0.2 });
    const done = new THREE.BufferGeometry();
    done.setAttribute("position", geometry.getAttribute("position"));
    const trail = new THREE.Line(done, new THREE.LineBasicMaterial({ color }));
    trail.frustumCulled = false;
    world.add(new THREE.Line(geometry, faint), trail);
    followers.push((i) => done.setDrawRange(0, i + 1));
  });
  // A cylinder of length 1 along y, put between two places.
  const between = (mesh, from, axis) => {
    const length = axis.length();
    mesh.visible = length > 0;
    mesh.position.copy(from).addScaledVector(axis, 0.5);
    mesh.scale.y = length;
    mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), axis.clone().normalize());
  };
  for (const line of scene.lines) {
    const mesh = new THREE.Mesh(new THREE.CylinderGeometry(thickness / 10, thickness / 10, 1, 12), paint("#44505c"));
    world.add(mesh);
    followers.push((i, s) => {
      const from = at(line.from, i, s);
      between(mesh, from, at(line.to, i, s).sub(from));
    });
  }

  // --- arrows: always in front; torques have two heads ---
  const kinds = { force: ["#c2185b", 1], torque: ["#6a1b9a", 2], reaction: ["#00796b", 1] };
  for (const arrow of scene.arrows) {
    const [color, heads] = kinds[arrow.kind];
    const material = Object.assign(paint(color), { depthTest: false, transparent: true });
    const group = new THREE.Group(), r = thickness / 5, head = 5 * r;
    const shaft = new THREE.Mesh(new THREE.CylinderGeometry(r, r, 1, 16), material);
    const cones = Array.from({ length: heads }, () => new THREE.Mesh(new THREE.CylinderGeometry(0, 2.4 * r, head, 20), material));
    group.add(shaft, ...cones);
    group.traverse((each) => { each.renderOrder = 1; });
    world.add(group);
    const tip = new THREE.Vector3();
    followers.push((i, s) => {
      const from = at(arrow.at, i, s), vector = at(arrow.vector, i, s), length = vector.length();
      group.visible = length > 1e-3 * radius;
      tip.copy(from).add(vector);
      if (!group.visible) return;
      const along = vector.clone().normalize(), small = Math.min(1, length / (1.5 * heads * head));
      between(shaft, from, along.clone().multiplyScalar(length - small * head));
      cones.forEach((cone, k) => {
        cone.position.copy(tip).addScaledVector(along, -small * head * (0.5 + 0.8 * k));
        cone.quaternion.copy(shaft.quaternion);
        cone.scale.setScalar(small);
      });
    });
    label(arrow.name, () => tip, color);
  }
  for (const [kind, largest] of Object.entries(scene.largest)) {
    row(chip(kind === "torque" ? "↠" : "→", kinds[kind][0]), kind + ", at most " + largest);
  }

  // --- the ground: a grid of round steps below the motion ---
  const exponent = Math.floor(Math.log10(radius));
  const step = [1, 2, 5, 10, 20].map((k) => k * 10 ** (exponent - 1)).find((k) => 2 * radius / k <= 16);
  const cells = 2 * Math.ceil(1.5 * radius / step);
  const grid = new THREE.GridHelper(cells * step, cells, 0xc4ccd4, 0xd5dce3);
  grid.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), V(up));
  // Its lines pass below the origin.
  for (const axis of [new THREE.Vector3(1, 0, 0), new THREE.Vector3(0, 0, 1)]) {
    axis.applyQuaternion(grid.quaternion);
    grid.position.addScaledVector(axis, Math.round(V(center).dot(axis) / step) * step);
  }
  grid.position.addScaledVector(V(up), floor - 0.03 * radius);
  world.add(grid);
  const place = grid.position.clone();
  const sides = [new THREE.Vector3(1, 0, 0), new THREE.Vector3(0, 0, 1)].map((side) => side.applyQuaternion(grid.quaternion));
  if (scene.follow.length > 0) followers.push((i, s) => {
    const way = at(scene.follow, i, s), more = way.clone().sub(gone);
    camera.position.add(more);
    controls.target.add(more);
    gone.copy(way);
    grid.position.copy(place);
    for (const side of sides) grid.position.addScaledVector(side, Math.round(way.dot(side) / step) * step);
  });
  row(chip("▦", "#98a4b0"), "grid " + Number(step.toPrecision(1)));

  // --- time ---
  const start = times[0], end = times[last];
  const slider = element("time"), speed = element("speed"), play = element("play");
  for (const factor of [0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10]) speed.add(new Option("×" + factor, factor, factor === 1, factor === 1));
  // The page opens at the fragment's time, such as #t=1.5, and then stands still.
  const asked = /^#t=(-?[\d.e+-]+)$/.exec(location.hash);
  let now = asked ? Math.min(end, Math.max(start, Number(asked[1]))) : start;
  let running = !asked && last > 0, before = null;
  const digits = last > 0 ? Math.min(9, Math.max(2, 2 - Math.floor(Math.log10(end - start)))) : 2;

  function show() {
    let low = 0, high = last;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= now) low = middle; else high = middle;
    }
    const s = last > 0 ? Math.min(1, Math.max(0, (now - times[low]) / (times[high] - times[low]))) : 0;
    followers.forEach((follow) => follow(low, s));
    slider.value = last > 0 ? (now - start) / (end - start) : 0;
    element("clock").textContent = "t = " + now.toFixed(digits) + " / " + end.toFixed(digits);
  }
  function setRunning(value) {
    running = value;
    play.textContent = running ? "Pause" : "Play";
  }
  play.onclick = () => {
    if (!running && now >= end) now = start;
    setRunning(!running);
  };
  slider.oninput = () => {
    setRunning(false);
    now = start + Number(slider.value) * (end - start);
  };
  element("home").onclick = lookAtAll;
  window.addEventListener("resize", resize);
  window.addEventListener("keydown", (event) => {
    if (event.code !== "Space" || event.target === play) return;
    event.preventDefault();
    play.onclick();
  });

  // --- labels: beside what they name, and not on one another ---
  function placeLabels() {
    const width = window.innerWidth, height = window.innerHeight, taken = [];
    for (const { span, place } of labels) {
      const p = place().clone().project(camera);
      span.hidden = p.z > 1;
      const x = Math.round((p.x + 1) / 2 * width) + 9;
      let y = Math.round((1 - p.y) / 2 * height) - 20;
      const wide = 7.5 * span.textContent.length;
      for (let tries = 0; tries < 8 && taken.some(([a, b, w]) => x < a + w && a < x + wide && Math.abs(y - b) < 15); tries++) y += 15;
      taken.push([x, y, wide]);
      span.style.transform = `translate(${x}px, ${y}px)`;
    }
  }

  function frame(stamp) {
    if (running && before !== null) {
      now += Number(speed.value) * (stamp - before) / 1000;
      if (now > end) now = start;
    }
    before = stamp;
    draw();
    requestAnimationFrame(frame);
  }
  function draw() {
    show();
    controls.update();
    sun.position.copy(camera.position).addScaledVector(V(up), 2 * radius);
    sun.target.position.copy(controls.target);
    renderer.render(world, camera);
    placeLabels();
  }
  resize();
  lookAtAll();
  setRunning(running);
  draw();
  document.body.dataset.drawn = renderer.info.render.triangles;
  requestAnimationFrame(frame);
})();
