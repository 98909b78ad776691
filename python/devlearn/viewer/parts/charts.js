// Over time: how the counts grow, how long rounds are, and which kinds of step there were.

const thousands = (count) => Math.round(count).toLocaleString("en").replaceAll(",", "\u2009");

/** A chart whose lines are drawn once a size, and over it a line where we are. */
class Chart {
  /** draw(context, box): the still part; cursor(frame): where we are, from 0 to 1; goTo(part). */
  constructor(canvas, { draw, cursor, goTo, margin = { left: 44, right: 8, top: 8, bottom: 20 } }) {
    Object.assign(this, { canvas, drawStill: draw, cursor, margin });
    let held = false;
    const go = (event) => {
      const { left, right } = this.margin;
      const box = canvas.getBoundingClientRect();
      const part = (event.clientX - box.left - left) / (box.width - left - right);
      goTo(Math.max(0, Math.min(1, part)));
    };
    canvas.addEventListener("pointerdown", (event) => {
      held = true;
      canvas.setPointerCapture(event.pointerId);
      go(event);
    });
    canvas.addEventListener("pointermove", (event) => held && go(event));
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(end, () => (held = false));
    }
  }

  resize(colours) {
    const ratio = window.devicePixelRatio || 1;
    const { clientWidth, clientHeight } = this.canvas;
    [this.canvas.width, this.canvas.height] = [clientWidth * ratio, clientHeight * ratio];
    this.still = canvasOf(Math.max(1, this.canvas.width), Math.max(1, this.canvas.height));
    const { left, right, top, bottom } = this.margin;
    this.box = { left, top, width: clientWidth - left - right, height: clientHeight - top - bottom };
    Object.assign(this, { ratio, colours });
    const context = this.still.getContext("2d");
    context.scale(ratio, ratio);
    context.font = `11px ${getComputedStyle(document.body).fontFamily}`;
    this.drawStill(context, this.box, colours);
  }

  draw(frame) {
    if (!this.still || !this.canvas.width) return;
    const context = this.canvas.getContext("2d");
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.drawImage(this.still, 0, 0);
    const { left, top, width, height } = this.box;
    context.scale(this.ratio, this.ratio);
    context.fillStyle = this.colours.target;
    context.fillRect(left + this.cursor(frame) * width - 0.75, top - 2, 1.5, height + 4);
  }
}

/** Two lines at the edges of a box, and what their ends mean. */
function drawAxes(context, { left, top, width, height }, colours, { ticks, below }) {
  context.strokeStyle = colours.line;
  context.fillStyle = colours.muted;
  context.lineWidth = 1;
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const [part, text] of ticks) {
    const y = Math.round(top + (1 - part) * height) + 0.5;
    context.beginPath();
    context.moveTo(left, y);
    context.lineTo(left + width, y);
    context.stroke();
    context.fillText(text, left - 6, y);
  }
  context.textBaseline = "top";
  below.forEach((text, i) => {
    context.textAlign = ["left", "center", "right"][i];
    context.fillText(text, left + (i * width) / 2, top + height + 5);
  });
}

/** NUM_RM and NUM_M over the steps. */
function drawCounts(run) {
  return (context, box, colours) => {
    const { left, top, width, height } = box;
    const columns = Math.max(2, Math.floor(width));
    const frames = Array.from({ length: columns }, (_, i) =>
      Math.round((i / (columns - 1)) * (run.frames - 1)),
    );
    const counts = frames.map((frame) => run.countsAt(frame));
    const most = Math.max(1, ...counts.map(([explored]) => explored));
    const total = run.stepAt(run.frames - 1);
    drawAxes(context, box, colours, {
      ticks: [[0, "0"], [0.5, ""], [1, thousands(most)]],
      below: ["0", "steps", thousands(total)],
    });
    [colours.explore, colours.exploit].forEach((colour, which) => {
      context.beginPath();
      counts.forEach((count, i) => {
        const x = left + (i / (columns - 1)) * width;
        context.lineTo(x, top + (1 - count[which] / most) * height);
      });
      context.strokeStyle = colour;
      context.lineWidth = 2;
      context.stroke();
    });
  };
}

/** Steps of each round, on a scale of powers of ten; rounds that never arrived are hollow. */
function drawRounds(run) {
  return (context, box, colours) => {
    const { left, top, width, height } = box;
    const steps = [...run.roundSteps].map((count) => Math.max(1, count));
    const low = Math.floor(Math.log10(steps.reduce((a, b) => Math.min(a, b), Infinity)));
    const high = Math.max(low + 1, Math.ceil(Math.log10(steps.reduce((a, b) => Math.max(a, b), 1))));
    const powers = Array.from({ length: high - low + 1 }, (_, i) => low + i);
    drawAxes(context, box, colours, {
      ticks: powers.map((power) => [(power - low) / (high - low), thousands(10 ** power)]),
      below: [`${run.roundNumber[0]}`, "rounds", `${run.roundNumber.at(-1)}`],
    });
    const last = Math.max(1, steps.length - 1);
    const radius = steps.length > 150 ? 1.5 : 2.5;
    steps.forEach((count, i) => {
      const x = left + (i / last) * width;
      const y = top + (1 - (Math.log10(count) - low) / (high - low)) * height;
      context.beginPath();
      context.arc(x, y, radius, 0, 2 * Math.PI);
      context.fillStyle = context.strokeStyle = run.roundArrived[i] ? colours.robot : colours.touch;
      if (run.roundArrived[i]) context.fill();
      else context.stroke();
    });
  };
}

/** The shares of the kinds of step, from the first to the last. */
function drawKinds(run) {
  return (context, { left, top, width, height }, colours) => {
    const columns = Math.max(1, Math.floor(width));
    for (let i = 0; i < columns; ++i) {
      const from = Math.floor((i / columns) * run.steps);
      const to = Math.max(from + 1, Math.floor(((i + 1) / columns) * run.steps));
      const shares = run.kinds.map(() => 0);
      for (let step = from; step < to; ++step) ++shares[run.kind[step]];
      let y = top;
      run.kinds.forEach((kind, k) => {
        const part = (shares[k] / (to - from)) * height;
        context.fillStyle = colours[kind];
        context.fillRect(left + i, y, 1.5, part);
        y += part;
      });
    }
  };
}
