// The arena: ground, obstacles, paths, arrows, sonars and the robot, on one canvas.

const MARGIN = 8; // around the arena [CSS pixels]
const PAST_BYTES = 96e6;
const PRESENT_BYTES = 32e6;
const NEAREST = 10; // radii of the robot across what is seen, at least
const EDGE = 0.12; // of what is seen, where the robot is about to leave it
const JUST_NOW = 150; // steps whose path is seen best

class Stage {
  constructor(canvas, run, place, ground) {
    Object.assign(this, { canvas, run, place, ground });
    this.context = canvas.getContext("2d", { alpha: false });
    this.zoom = 1;
    this.centre = { x: place.left + place.width / 2, y: place.low + place.height / 2 };
    this.preferences = new Preferences(run);
    this.past = new Trail({
      run, draw: drawRoundPaths, count: run.rounds, alpha: 0.16, least: 1, bytes: PAST_BYTES,
    });
    this.present = new Trail({
      run, draw: drawPath, count: run.frames, alpha: 1, least: 500, bytes: PRESENT_BYTES,
    });
  }

  /** Anew, at a width [CSS pixels] and in these colours. */
  resize(width, colours) {
    Object.assign(this, { width, colours });
    this.#layOut();
  }

  /** Nearer by a factor, where a point of the arena stays where it is seen. */
  zoomBy(factor, { x, y }) {
    const { place, run, centre } = this;
    const nearest = Math.min(place.width, place.height) / (NEAREST * run.robot.radius);
    const zoom = Math.max(1, Math.min(this.zoom * factor, nearest));
    const rest = this.zoom / zoom;
    if (rest === 1) return;
    this.zoom = zoom;
    this.#centreAt(x + (centre.x - x) * rest, y + (centre.y - y) * rest);
  }

  /** What is seen moves by so much [CSS pixels]. */
  pan(dx, dy) {
    const { view, centre } = this;
    this.#centreAt(
      centre.x - (dx * view.ratio) / view.scale,
      centre.y + (dy * view.ratio) / view.scale,
    );
  }

  /** Moves what is seen where a pose is about to leave it. */
  keepInView({ x, y }) {
    if (this.zoom === 1 || !this.view) return;
    const { view } = this;
    const [right, down] = [view.px(x) / view.width, view.py(y) / view.height];
    if (Math.min(right, down) < EDGE || Math.max(right, down) > 1 - EDGE) this.#centreAt(x, y);
  }

  // Never beyond the arena.
  #centreAt(x, y) {
    const { place, zoom } = this;
    const within = (value, low, length) => {
      const half = length / zoom / 2;
      return Math.max(low + half, Math.min(low + length - half, value));
    };
    this.centre = {
      x: within(x, place.left, place.width),
      y: within(y, place.low, place.height),
    };
    this.#layOut();
  }

  #layOut() {
    const { place, width, colours, zoom, centre } = this;
    const ratio = window.devicePixelRatio || 1;
    const whole = ((width - 2 * MARGIN) / place.width) * ratio;
    const scale = whole * zoom;
    const [across, high] = [width * ratio, place.height * whole + 2 * MARGIN * ratio];
    this.view = {
      ratio,
      scale,
      width: Math.max(1, Math.round(across)),
      height: Math.max(1, Math.round(high)),
      px: (x) => across / 2 + (x - centre.x) * scale,
      py: (y) => high / 2 - (y - centre.y) * scale,
    };
    [this.canvas.width, this.canvas.height] = [this.view.width, this.view.height];
    this.canvas.style.height = `${this.view.height / ratio}px`;
    if (this.run.hasSteps) {
      this.past.begin(this.view, colours);
      this.present.begin(this.view, colours);
    }
    this.obstacles = canvasOf(this.view.width, this.view.height);
    this.#drawStill(this.obstacles.getContext("2d"));
  }

  /** The point of the canvas [CSS pixels] over a point of the arena. */
  pixelAt(x, y) {
    const { view } = this;
    return [view.px(x) / view.ratio, view.py(y) / view.ratio];
  }

  /** The point of the arena under a point of the canvas [CSS pixels]. */
  pointAt(x, y) {
    const { view, place } = this;
    const [left, low] = [view.px(place.left), view.py(place.low)];
    return {
      x: place.left + (x * view.ratio - left) / view.scale,
      y: place.low + (low - y * view.ratio) / view.scale,
    };
  }

  /** What is shown: a frame, the robot's pose, which layers, and the cell pointed at. */
  draw({ frame, pose, layers, pointed }) {
    const { context, run, view, place } = this;
    const time = run.timeAt(frame);
    context.drawImage(this.#floor(layers.ground, frame), 0, 0);
    if (run.hasSteps) {
      const round = run.roundOf(frame);
      const first = run.firstFrame[round];
      if (layers.paths) context.drawImage(this.past.to(0, round), 0, 0);
      context.globalAlpha = 0.4;
      context.drawImage(this.present.to(first, frame), 0, 0);
      context.globalAlpha = 1;
      const { colours } = this;
      drawPath({ run, context, view, colours, alpha: 1 }, Math.max(first, frame - JUST_NOW), frame);
    }
    context.drawImage(this.obstacles, 0, 0);
    place.moversAt(time).forEach((outline) => this.#fill(context, outline));
    if (layers.arrows) this.#drawArrows(this.preferences.at(frame));
    if (pointed) this.#drawCell(pointed, this.colours.ink, []);
    this.#drawTarget();
    if (layers.sonars) this.#drawSonars(pose, frame);
    this.#drawRobot(pose);
    const step = run.stepsTo(frame);
    if (run.trueSituation && step < run.steps) {
      const [believed, really] = [run.situation[step], run.trueSituation[step]];
      if (believed !== really) this.#drawCell(run.cellOf(believed), this.colours.touch, [4, 3]);
    }
  }

  // The ground in the arena's size, drawn once as long as it stays the same.
  #floor(kind, frame) {
    const { view, place, run, colours } = this;
    const image = this.ground.picture(kind, colours.ramp, run.stepAt(frame));
    if (this.under?.image === image && this.under.view === view) return this.under.canvas;
    const canvas = canvasOf(view.width, view.height);
    const context = canvas.getContext("2d", { alpha: false });
    context.fillStyle = colours.floor;
    context.fillRect(0, 0, view.width, view.height);
    if (image) {
      const { grid } = run;
      const over = kind === "SEF" ? place : { left: grid.origin[0], low: grid.origin[1], ...grid };
      const [x, y] = [view.px(over.left), view.py(over.low + over.height)];
      context.imageSmoothingEnabled = kind === "SEF";
      context.drawImage(image, x, y, over.width * view.scale, over.height * view.scale);
    }
    this.under = { image, view, canvas };
    return canvas;
  }

  #drawStill(context) {
    const { view, place, colours } = this;
    context.save();
    context.beginPath();
    place.walls.forEach(([x, y]) => context.lineTo(view.px(x), view.py(y)));
    context.closePath();
    context.clip();
    place.outlines.forEach((outline) => this.#fill(context, outline));
    context.setLineDash([4 * view.ratio, 3 * view.ratio]);
    context.strokeStyle = colours.edge;
    place.movers.forEach((mover) => {
      context.beginPath();
      mover.course.forEach(([x, y]) => context.lineTo(view.px(x), view.py(y)));
      context.stroke();
    });
    context.restore();
    context.strokeStyle = colours.ink;
    context.lineWidth = 2 * view.ratio;
    context.strokeRect(
      view.px(place.left), view.py(place.low + place.height),
      place.width * view.scale, place.height * view.scale,
    );
    const { x, y } = place.world.start;
    context.strokeStyle = colours.robot;
    context.lineWidth = 1.5 * view.ratio;
    context.beginPath();
    context.arc(view.px(x), view.py(y), this.run.robot.radius * view.scale, 0, 2 * Math.PI);
    context.stroke();
  }

  #fill(context, { center, radius, rings = [], closed }) {
    const { view, colours } = this;
    context.beginPath();
    if (radius) context.arc(view.px(center[0]), view.py(center[1]), radius * view.scale, 0, 2 * Math.PI);
    for (const ring of rings) {
      ring.forEach(([x, y], i) => context[i ? "lineTo" : "moveTo"](view.px(x), view.py(y)));
      if (closed) context.closePath();
    }
    context.fillStyle = colours.obstacle;
    context.strokeStyle = colours.edge;
    context.lineWidth = (closed === false ? 2.5 : 1.2) * view.ratio;
    if (radius || closed) context.fill("evenodd");
    context.stroke();
  }

  // Longer where the headings of a cell agree, darker where it was learned more often.
  #drawArrows(arrows) {
    const { context, view, run, colours } = this;
    if (!arrows.length) return;
    const { grid } = run;
    const longest = 0.42 * Math.min(grid.width / grid.columns, grid.height / grid.rows) * view.scale;
    const most = Math.log1p(arrows.reduce((times, arrow) => Math.max(times, arrow.times), 1));
    const LEVELS = 4;
    for (let level = 0; level < LEVELS; ++level) {
      const [shafts, heads] = [new Path2D(), new Path2D()];
      for (const { x, y, u, v, times } of arrows) {
        const share = Math.min(LEVELS - 1, Math.floor((Math.log1p(times) / most) * LEVELS));
        if (share !== level) continue;
        const [px, py] = [view.px(x), view.py(y)];
        const length = Math.hypot(u, v) * longest;
        if (times === 0 || length < 1.5 * view.ratio) {
          heads.moveTo(px + view.ratio, py);
          heads.arc(px, py, view.ratio, 0, 2 * Math.PI);
          continue;
        }
        const [dx, dy] = [(u / Math.hypot(u, v)) * length, (-v / Math.hypot(u, v)) * length];
        shafts.moveTo(px - dx, py - dy);
        shafts.lineTo(px + 0.4 * dx, py + 0.4 * dy);
        heads.moveTo(px + dx, py + dy);
        heads.lineTo(px + 0.25 * dx - 0.42 * dy, py + 0.25 * dy + 0.42 * dx);
        heads.lineTo(px + 0.25 * dx + 0.42 * dy, py + 0.25 * dy - 0.42 * dx);
        heads.closePath();
      }
      context.globalAlpha = 0.25 + (0.65 * level) / (LEVELS - 1);
      context.strokeStyle = context.fillStyle = colours.arrow;
      context.lineWidth = Math.max(1, Math.min(4 * view.ratio, 0.16 * longest));
      context.stroke(shafts);
      context.fill(heads);
    }
    context.globalAlpha = 1;
  }

  #drawCell(cell, colour, dash) {
    if (!cell) return;
    const { context, view } = this;
    const [width, height] = [cell.width * view.scale, cell.height * view.scale];
    const [x, y] = [view.px(cell.x), view.py(cell.y)];
    context.strokeStyle = colour;
    context.lineWidth = 2 * view.ratio;
    context.setLineDash(dash.map((length) => length * view.ratio));
    context.strokeRect(x - width / 2, y - height / 2, width, height);
    context.setLineDash([]);
    const way = cell.heading * RADIANS;
    const reach = 0.5 * Math.min(width, height);
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + reach * Math.cos(way), y - reach * Math.sin(way));
    context.stroke();
  }

  /** Echoes [m] as recorded, else as geometry has them at a pose. */
  echoes(frame, pose = this.run.poseAt(frame)) {
    const { run, place } = this;
    const count = run.sonarAngles.length;
    const atStart = !run.hasSteps || frame === run.firstFrame[run.roundOf(frame)];
    if (run.echoes && !atStart) {
      return run.echoes.subarray((run.stepsTo(frame) - 1) * count, run.stepsTo(frame) * count);
    }
    return place.echoes(pose, run.sonarAngles, run.robot, run.timeAt(frame));
  }

  #drawSonars(pose, frame) {
    const { context, view, run, colours } = this;
    context.strokeStyle = context.fillStyle = colours.sonar;
    context.lineWidth = 1.2 * view.ratio;
    this.echoes(frame, pose).forEach((echo, i) => {
      const way = (pose.heading + run.sonarAngles[i]) * RADIANS;
      const met = echo < run.robot.sonar_range * (1 - 1e-4);
      const [from, to] = [run.robot.radius, run.robot.radius + echo];
      const [dx, dy] = [Math.cos(way), Math.sin(way)];
      context.setLineDash(met ? [] : [3 * view.ratio, 4 * view.ratio]);
      context.beginPath();
      context.moveTo(view.px(pose.x + from * dx), view.py(pose.y + from * dy));
      const [x, y] = [view.px(pose.x + to * dx), view.py(pose.y + to * dy)];
      context.lineTo(x, y);
      context.stroke();
      context.setLineDash([]);
      if (!met) return;
      context.beginPath();
      context.arc(x, y, 2.6 * view.ratio, 0, 2 * Math.PI);
      context.fill();
    });
  }

  #drawRobot({ x, y, heading }) {
    const { context, view, run, colours } = this;
    const radius = Math.max(4 * view.ratio, run.robot.radius * view.scale);
    const [px, py] = [view.px(x), view.py(y)];
    context.beginPath();
    context.arc(px, py, radius, 0, 2 * Math.PI);
    context.fillStyle = colours.robot;
    context.fill();
    context.strokeStyle = colours.floor;
    context.lineWidth = 2 * view.ratio;
    context.stroke();
    const way = heading * RADIANS;
    const [dx, dy] = [Math.cos(way) * radius, -Math.sin(way) * radius];
    context.beginPath();
    context.moveTo(px + 0.75 * dx, py + 0.75 * dy);
    context.lineTo(px - 0.4 * dx - 0.5 * dy, py - 0.4 * dy + 0.5 * dx);
    context.lineTo(px - 0.4 * dx + 0.5 * dy, py - 0.4 * dy - 0.5 * dx);
    context.closePath();
    context.fillStyle = "#fff";
    context.fill();
  }

  #drawTarget() {
    const { context, view, run, colours } = this;
    const { x, y } = run.world.target;
    const [px, py] = [view.px(x), view.py(y)];
    const size = Math.max(8 * view.ratio, run.goalRadius * view.scale);
    context.beginPath();
    for (let i = 0; i < 10; ++i) {
      const reach = i % 2 ? 0.42 * size : size;
      context.lineTo(px + reach * Math.sin((i * Math.PI) / 5), py - reach * Math.cos((i * Math.PI) / 5));
    }
    context.closePath();
    context.fillStyle = colours.target;
    context.fill();
    context.strokeStyle = colours.floor;
    context.lineWidth = 1.5 * view.ratio;
    context.stroke();
  }
}
