// The ground: SEF over the arena, or what an adaptive learner makes of it cell by cell.

const BANDS = 16;

/** Colours from the least to the most, in steps that look like contour lines. */
function bandOf(ramp, part) {
  const band = Math.min(BANDS - 1, Math.floor(Math.max(0, Math.min(1, part)) * BANDS));
  const at = (band / (BANDS - 1)) * (ramp.length - 1);
  const i = Math.min(ramp.length - 2, Math.floor(at));
  return ramp[i].map((from, channel) => from + (at - i) * (ramp[i + 1][channel] - from));
}

function canvasOf(width, height) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [width, height];
  return canvas;
}

/** A picture of pixels, the first row at the top; `colourAt` gives red, green, blue or null. */
function picture(width, height, colourAt) {
  const canvas = canvasOf(width, height);
  const context = canvas.getContext("2d");
  const image = context.createImageData(width, height);
  for (let row = 0; row < height; ++row) {
    for (let column = 0; column < width; ++column) {
      const colour = colourAt(column, row);
      if (colour) image.data.set([...colour, 255], 4 * (row * width + column));
    }
  }
  context.putImageData(image, 0, 0);
  return canvas;
}

const FINER = 4; // pixels between two points of the field

class Ground {
  constructor(run) {
    this.run = run;
    this.kinds = ["none"];
    if (run.field) this.kinds.push("SEF");
    if (run.adaptive && run.grid) this.kinds.push("adaptive SEF");
  }

  /** SEF at a point; beyond its scale's end, where obstacles are, that end. */
  sefAt(x, y) {
    const { origin, width, height } = this.run.world.arena;
    const { columns, rows } = this.run.world.field;
    return this.#between(((x - origin[0]) / width) * (columns - 1), ((y - origin[1]) / height) * (rows - 1));
  }

  #between(column, row) {
    const { field, world } = this.run;
    const { columns, rows } = world.field;
    const i = Math.max(0, Math.min(columns - 2, Math.floor(column)));
    const j = Math.max(0, Math.min(rows - 2, Math.floor(row)));
    const [a, b] = [Math.min(1, column - i), Math.min(1, row - j)];
    const at = j * columns + i;
    const low = field[at] * (1 - a) + field[at + 1] * a;
    const high = field[at + columns] * (1 - a) + field[at + columns + 1] * a;
    return low * (1 - b) + high * b;
  }

  /** A picture over the arena, or null; what it needs is computed once a theme and moment. */
  picture(kind, ramp, step) {
    if (kind === "none") return null;
    if (kind === "adaptive SEF") this.run.adaptive.to(step);
    const key = `${kind} ${ramp} ${kind === "SEF" ? "" : this.run.adaptive.moment}`;
    if (this.key !== key) {
      this.key = key;
      this.drawn = kind === "SEF" ? this.#sef(ramp) : this.#adaptive(ramp);
    }
    return this.drawn;
  }

  #sef(ramp) {
    const { columns, rows } = this.run.world.field;
    const { low, high } = this.range("SEF");
    const [width, height] = [(columns - 1) * FINER, (rows - 1) * FINER];
    return picture(width, height, (i, j) => {
      const sef = this.#between((i + 0.5) / FINER, (height - j - 0.5) / FINER);
      return bandOf(ramp, (sef - low) / (high - low || 1));
    });
  }

  // The adaptive SEF, -(Phi + E_S), at each cell's centre, where it is best to head.
  #adaptive(ramp) {
    const { grid } = this.run;
    const values = this.#cells();
    const { low, high } = this.range("adaptive SEF");
    return picture(grid.columns, grid.rows, (i, j) => {
      const value = values[(grid.rows - 1 - j) * grid.columns + i];
      return Number.isNaN(value) ? null : bandOf(ramp, (value - low) / (high - low || 1));
    });
  }

  #cells() {
    const { run } = this;
    const { adaptive, grid } = run;
    const step = run.robot.speed * run.robot.sample_time;
    const values = new Float64Array(grid.columns * grid.rows).fill(NaN);
    for (let number = 0; number < adaptive.learner.known[adaptive.moment]; ++number) {
      const cell = run.cellOf(number);
      if (!cell) continue;
      const { target } = run.world;
      const estimate = Math.hypot(cell.x - target.x, cell.y - target.y) / step;
      const value = -(estimate + adaptive.expected(number));
      if (!(values[cell.cell] >= value)) values[cell.cell] = value;
    }
    return values;
  }

  /** What the ends of the scale mean. */
  range(kind) {
    this.ranges ??= {};
    if (kind === "SEF" && !this.ranges[kind]) {
      const { field } = this.run;
      this.ranges[kind] = field.reduce(
        ({ low, high }, sef) => ({ low: Math.min(low, sef), high: Math.max(high, sef) }),
        { low: Infinity, high: -Infinity },
      );
    }
    if (kind === "adaptive SEF" && !this.ranges[kind]) {
      const now = this.run.adaptive.moment;
      this.run.adaptive.to(Infinity);
      const values = this.#cells().filter((value) => !Number.isNaN(value)).sort();
      this.run.adaptive.moment = now;
      const low = values[Math.floor(0.05 * values.length)] ?? -1; // but for a few far off
      this.ranges[kind] = { low, high: 0 };
    }
    return this.ranges[kind];
  }
}
