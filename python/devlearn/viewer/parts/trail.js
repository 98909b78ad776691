// Where the robot went: a bitmap that grows with its path, and copies of it to go back to.

/** How a kind of step is drawn: told apart by width and dashes, not by colour alone. */
const KIND_LOOKS = {
  explore: { width: 2.4, dash: [] },
  exploit: { width: 1.3, dash: [] },
  exhausted: { width: 1.2, dash: [2, 2] },
  unstated: { width: 1.3, dash: [] },
  habit: { width: 2, dash: [] },
  deviation: { width: 2.4, dash: [5, 2] },
  held: { width: 1.3, dash: [] },
};

/** A bitmap of units, rounds or frames, drawn one after the other. */
class Trail {
  /** draw(trail, from, to): draws these units. count: of all. bytes: that its copies may take. */
  constructor({ run, draw, count, alpha, least, bytes }) {
    Object.assign(this, { run, draw, count, alpha, least, bytes });
    this.canvas = canvasOf(1, 1);
  }

  /** Anew, at another size or in other colours. */
  begin(view, colours) {
    Object.assign(this, { view, colours, first: 0, last: 0, copies: [] });
    [this.canvas.width, this.canvas.height] = [view.width, view.height];
    this.context = this.canvas.getContext("2d");
    const most = Math.max(1, Math.floor(this.bytes / (4 * view.width * view.height)));
    this.stride = Math.max(this.least, Math.ceil(this.count / most));
  }

  /** The bitmap of the units from `first` to before `last`. */
  to(first, last) {
    if (first !== this.first) {
      this.copies = [];
      this.last = Infinity;
    }
    this.#startNear(first, last);
    while (this.last < last) {
      const next = Math.min(last, (Math.floor(this.last / this.stride) + 1) * this.stride);
      this.draw(this, this.last, next);
      this.last = next;
      if (next % this.stride === 0) this.#keep();
    }
    return this.canvas;
  }

  // From what is drawn, or from a copy, whichever is nearer before `last`; else from nothing.
  #startNear(first, last) {
    const copy = this.copies.findLast((kept) => kept.last <= last);
    if (this.last <= last && this.last >= (copy?.last ?? 0)) return;
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    if (copy) this.context.drawImage(copy.canvas, 0, 0);
    this.first = first;
    this.last = copy?.last ?? first;
  }

  #keep() {
    if (this.copies.some((kept) => kept.last === this.last)) return;
    const canvas = canvasOf(this.canvas.width, this.canvas.height);
    canvas.getContext("2d").drawImage(this.canvas, 0, 0);
    this.copies.push({ last: this.last, canvas });
    this.copies.sort((a, b) => a.last - b.last);
  }
}

/** Rounds: the more went somewhere, the better it is seen. */
function drawRoundPaths(trail, from, to) {
  const { firstFrame } = trail.run;
  for (let round = from; round < to; ++round) {
    drawPath(trail, firstFrame[round], firstFrame[round + 1] - 1);
  }
}

/** The path of the steps after frame `from` up to frame `to`: a line for each kind of step, and
 * crosses where something was touched. */
function drawPath({ run, context, view, colours, alpha }, from, to) {
  const faint = alpha < 0.3;
  const paths = run.kinds.map(() => null);
  const touches = new Path2D();
  const cross = 2.2 * view.ratio;
  let round = run.roundOf(from);
  for (let frame = from + 1; frame <= to; ++frame) {
    while (frame >= run.firstFrame[round + 1]) ++round;
    if (frame === run.firstFrame[round]) continue; // put there, not driven
    const step = frame - round - 1;
    const path = (paths[run.kind[step]] ??= new Path2D());
    path.moveTo(view.px(run.x[frame - 1]), view.py(run.y[frame - 1]));
    const [x, y] = [view.px(run.x[frame]), view.py(run.y[frame])];
    path.lineTo(x, y);
    if (run.collided[step] && !faint) {
      touches.moveTo(x - cross, y - cross);
      touches.lineTo(x + cross, y + cross);
      touches.moveTo(x - cross, y + cross);
      touches.lineTo(x + cross, y - cross);
    }
  }
  context.globalAlpha = alpha;
  context.lineCap = "round";
  paths.forEach((path, kind) => {
    if (!path) return;
    const look = KIND_LOOKS[run.kinds[kind]];
    context.strokeStyle = colours[run.kinds[kind]];
    context.lineWidth = (faint ? 1 : look.width) * view.ratio;
    context.setLineDash(faint ? [] : look.dash.map((length) => length * view.ratio));
    context.stroke(path);
  });
  context.setLineDash([]);
  context.strokeStyle = colours.touch;
  context.lineWidth = 1.2 * view.ratio;
  context.stroke(touches);
  context.globalAlpha = 1;
}
