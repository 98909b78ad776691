// The world's shapes: outlines to draw, edges for the sonars, and movers on their ways.

const RADIANS = Math.PI / 180;

/** The corners of a rectangle around a centre. */
function cornersOf({ size, angle = 0 }, [x, y]) {
  const [c, s] = [Math.cos(angle * RADIANS), Math.sin(angle * RADIANS)];
  return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => {
    const [right, up] = [(a * size[0]) / 2, (b * size[1]) / 2];
    return [x + c * right - s * up, y + s * right + c * up];
  });
}

/** A shape as a circle, or as rings of points: closed ones are filled. */
function outlineOf(shape, center = shape.center) {
  switch (shape.shape) {
    case "circle":
      return { center, radius: shape.radius };
    case "rectangle":
      return { rings: [cornersOf(shape, center)], closed: true };
    case "polygon":
      return { rings: [shape.corners, ...(shape.holes ?? [])], closed: true };
    default:
      return { rings: [shape.points], closed: false };
  }
}

class Mover {
  constructor(told) {
    this.told = told;
    if (told.path) {
      const { points, then } = told.path;
      this.points = then === "around" ? [...points, points[0]] : points;
      this.gone = [0];
      for (let i = 1; i < this.points.length; ++i) {
        const [a, b] = [this.points[i - 1], this.points[i]];
        this.gone.push(this.gone[i - 1] + Math.hypot(b[0] - a[0], b[1] - a[1]));
      }
    }
  }

  /** Where its centre is at a time [s]. */
  placeAt(time) {
    if (this.told.walk) {
      const { waypoints, from, leg_time: legTime } = this.told.walk;
      const leg = Math.min(Math.max(0, Math.floor(time / legTime) - from), waypoints.length - 2);
      return between(waypoints[leg], waypoints[leg + 1], Math.min(1, time / legTime - from - leg));
    }
    const length = this.gone.at(-1);
    let far = this.told.path.speed * time;
    if (this.told.path.then === "stop") far = Math.min(far, length);
    else if (this.told.path.then === "around") far %= length;
    else far = length - Math.abs(length - (far % (2 * length)));
    let leg = 0;
    while (leg < this.gone.length - 2 && this.gone[leg + 1] <= far) ++leg;
    const part = (far - this.gone[leg]) / (this.gone[leg + 1] - this.gone[leg]);
    return between(this.points[leg], this.points[leg + 1], part);
  }

  outlineAt(time) {
    return outlineOf(this.told, this.placeAt(time));
  }

  /** Where it ever goes: points of its path, or the box of its walk. */
  get course() {
    if (this.told.path) return this.points;
    const { low, high } = this.told.walk;
    return [low, [high[0], low[1]], high, [low[0], high[1]], low];
  }
}

function between(a, b, part) {
  return [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])];
}

/** What sonars hear: edges as rows of x, y, x, y, and circles. */
class Surroundings {
  constructor(outlines) {
    this.circles = outlines.filter((outline) => outline.radius);
    const edges = [];
    for (const { rings = [], closed } of outlines) {
      for (const ring of rings) {
        for (let i = closed ? 0 : 1; i < ring.length; ++i) {
          edges.push(...ring.at(i - 1), ...ring[i]);
        }
      }
    }
    this.edges = Float64Array.from(edges);
  }

  /** How far a ray from a point goes before it meets something; at most `range`. */
  echo(x, y, dx, dy, range) {
    let least = range;
    const { edges } = this;
    for (let i = 0; i < edges.length; i += 4) {
      const [ax, ay] = [edges[i] - x, edges[i + 1] - y];
      const [ex, ey] = [edges[i + 2] - edges[i], edges[i + 3] - edges[i + 1]];
      const across = dx * ey - dy * ex;
      if (across === 0) continue;
      const far = (ax * ey - ay * ex) / across;
      if (far < 0 || far >= least) continue;
      const along = (ax * dy - ay * dx) / across;
      if (along >= 0 && along <= 1) least = far;
    }
    for (const { center, radius } of this.circles) {
      const [cx, cy] = [center[0] - x, center[1] - y];
      const along = cx * dx + cy * dy;
      const inside = radius * radius - (cx * cx + cy * cy - along * along);
      if (inside < 0) continue;
      const far = along - Math.sqrt(inside);
      if (far >= 0) least = Math.min(least, far);
      else if (along + Math.sqrt(inside) > 0) least = 0;
    }
    return least;
  }
}

class Place {
  constructor({ world }) {
    this.world = world;
    const { origin, width, height } = world.arena;
    [this.left, this.low] = origin;
    [this.width, this.height] = [width, height];
    const [right, top] = [this.left + width, this.low + height];
    this.walls = [[this.left, this.low], [right, this.low], [right, top], [this.left, top]];
    this.outlines = world.obstacles.map((shape) => outlineOf(shape));
    this.movers = (world.movers ?? []).map((told) => new Mover(told));
    this.still = new Surroundings([...this.outlines, { rings: [this.walls], closed: true }]);
  }

  /** Outlines of the movers at a time [s]; none where it is not known. */
  moversAt(time) {
    return Number.isNaN(time) ? [] : this.movers.map((mover) => mover.outlineAt(time));
  }

  /** The echoes [m] of sonars at these angles, by geometry alone: from the body's rim. */
  echoes({ x, y, heading }, angles, robot, time) {
    const moving = new Surroundings(this.moversAt(time));
    return angles.map((angle) => {
      const way = (heading + angle) * RADIANS;
      const [dx, dy] = [Math.cos(way), Math.sin(way)];
      const ray = [x + robot.radius * dx, y + robot.radius * dy, dx, dy];
      return moving.echo(...ray, this.still.echo(...ray, robot.sonar_range));
    });
  }
}
