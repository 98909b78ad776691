// What happened, frame by frame: one before the steps of each round, and one after each step.

class Run {
  constructor(data) {
    Object.assign(this, data);
    this.rounds = this.roundNumber?.length ?? 0;
    this.hasSteps = this.shows === "steps";
    this.sampleTime = this.robot.sample_time;
    if (!this.hasSteps) {
      const start = this.world.start;
      const frames = this.shows === "world" ? 1 + Math.round(this.times[1] / this.sampleTime) : 1;
      this.frames = Math.max(1, frames);
      this.x = new Float64Array(this.frames).fill(start.x);
      this.y = new Float64Array(this.frames).fill(start.y);
      this.heading = new Float64Array(this.frames).fill(start.heading);
      return;
    }
    this.frames = this.x.length;
    this.steps = this.motion.length;
    this.firstFrame = new Uint32Array(this.rounds + 1);
    this.firstStep = new Float64Array(this.rounds + 1); // of all, where some are left out
    for (let r = 0; r < this.rounds; ++r) {
      this.firstFrame[r + 1] = this.firstFrame[r] + this.roundShown[r] + 1;
      this.firstStep[r + 1] = this.firstStep[r] + this.roundSteps[r];
    }
    if (this.thinned) this.firstStep = Float64Array.from([...this.roundFirst, this.total]);
    this.ids = Array.from(this.idLow, (low, i) => {
      const id = this.idHigh[i] * 2 ** 32 + low;
      return id <= Number.MAX_SAFE_INTEGER
        ? id
        : ((BigInt(this.idHigh[i]) << 32n) | BigInt(low)).toString();
    });
    this.numberOf = new Map(this.ids.map((id, number) => [id, number]));
    if (this.learner?.kind === "paper") this.#follow();
    if (this.learner?.kind === "adaptive") this.adaptive = new Adaptive(this);
  }

  // The paper's learner, through all steps; as far as all of it comes to what the record says.
  #follow() {
    const { config, known, final, eventCounts, reduced } = this.learner;
    const learner = new Learner(config, this.ids.length);
    learner.load(this);
    this.replay = new Replay(learner, this);
    ({ event: this.event, explored: this.exploredAt, effective: this.effectiveAt } = this.replay);
    const events = eventCounts.map(() => 0);
    this.event.forEach((event) => ++events[event]);
    const same =
      this.exploredAt[this.steps] === final.explored &&
      this.effectiveAt[this.steps] === final.effective &&
      this.replay.reduced.reduce((sum, count) => sum + count, 0) === reduced &&
      events.every((count, event) => count === eventCounts[event]);
    if (same) return;
    delete this.replay;
    this.notes.push(
      "The learner's lists cannot be followed: with what it met it would have learned otherwise. " +
        "It learned elsewhere, too, or its settings are not those of the record.",
    );
  }

  /** Index of the round that a frame is in. */
  roundOf(frame) {
    let low = 0;
    let high = this.rounds - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.firstFrame[middle] <= frame) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** Steps shown up to a frame: index of the next one in the columns. */
  stepsTo(frame) {
    return this.hasSteps ? frame - this.roundOf(frame) : 0;
  }

  /** Steps that the record's robot had made. */
  stepAt(frame) {
    if (!this.hasSteps) return 0;
    const round = this.roundOf(frame);
    const inRound = frame - this.firstFrame[round];
    if (!this.thinned) return this.firstStep[round] + inRound;
    return inRound ? this.stepNumber[frame - round - 1] : this.firstStep[round];
  }

  /** The frame after so many steps of the record; where steps are left out, the next one shown. */
  frameOf(step) {
    if (!this.hasSteps || step <= 0) return 0;
    let low = 0;
    let high = this.steps - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.thinned ? this.stepNumber[middle] : middle + 1) >= step) high = middle;
      else low = middle + 1;
    }
    let round = 0; // the one that the step with this index is in
    let first = 0;
    for (let [a, b] = [0, this.rounds - 1]; a <= b; ) {
      const middle = (a + b) >> 1;
      if (this.firstFrame[middle] - middle <= low) {
        round = middle;
        a = middle + 1;
      } else b = middle - 1;
    }
    first = this.firstFrame[round] - round;
    return this.firstFrame[round] + 1 + low - first;
  }

  /** The world's time at a frame [s]; NaN where the record does not say. */
  timeAt(frame) {
    if (!this.hasSteps) return frame * this.sampleTime;
    const round = this.roundOf(frame);
    const began = this.roundBegan[round];
    return began < 0 ? NaN : (began + this.stepAt(frame) - this.firstStep[round]) * this.sampleTime;
  }

  poseAt(frame) {
    return { x: this.x[frame], y: this.y[frame], heading: this.heading[frame] };
  }

  /** NUM_RM and NUM_M at a frame. */
  countsAt(frame) {
    const made = this.stepsTo(frame);
    if (this.exploredAt) return [this.exploredAt[made], this.effectiveAt[made]];
    return made ? [this.explored[made - 1], this.effective[made - 1]] : [0, 0];
  }

  /** The last step before `made` in a situation; -1 for none. */
  lastIn(situation, made) {
    return this.situation.subarray(0, made).lastIndexOf(situation);
  }

  // --- the grid of situations

  /** Cell and heading of a situation by its id; null for situations that are no cells. */
  cellOfId(id) {
    const { grid } = this;
    if (!grid || typeof id !== "number") return null;
    const cell = Math.floor(id / grid.headings);
    if (cell >= grid.columns * grid.rows) return null;
    const [width, height] = [grid.width / grid.columns, grid.height / grid.rows];
    return {
      cell,
      x: grid.origin[0] + ((cell % grid.columns) + 0.5) * width,
      y: grid.origin[1] + (Math.floor(cell / grid.columns) + 0.5) * height,
      width,
      height,
      heading: ((id % grid.headings) * 360) / grid.headings,
    };
  }

  /** The same by its number among those of the page. */
  cellOf(number) {
    return this.cellOfId(this.ids[number]);
  }

  /** Id of the situation of a pose. */
  idAt({ x, y, heading }) {
    const { grid } = this;
    const part = (value, from, length, count) =>
      Math.min(count - 1, Math.max(0, Math.floor(((value - from) / length) * count)));
    const column = part(x, grid.origin[0], grid.width, grid.columns);
    const row = part(y, grid.origin[1], grid.height, grid.rows);
    const bin = Math.floor((heading * grid.headings) / 360 + 0.5) % grid.headings;
    return (row * grid.columns + column) * grid.headings + ((bin + grid.headings) % grid.headings);
  }
}

/** An adaptive learner at some moments: expected losses and numbers of outcomes. */
class Adaptive {
  constructor({ learner, losses, outcomes, firstEstimate }) {
    Object.assign(this, { learner, losses, outcomes, firstEstimate, moment: 0 });
    this.motionCount = learner.config.motion_count;
    this.size = firstEstimate.length * this.motionCount;
  }

  /** The last moment told before a step or at it. */
  to(step) {
    let moment = this.learner.moments.findIndex((told) => told > step);
    if (moment < 0) moment = this.learner.moments.length;
    this.moment = Math.max(0, moment - 1);
    return this;
  }

  get step() {
    return this.learner.moments[this.moment];
  }

  met(number) {
    return number < this.learner.known[this.moment];
  }

  /** q and outcomes of each motion, E, and the lists, which are views of them. */
  explain(number) {
    const from = this.moment * this.size + number * this.motionCount;
    const losses = [...this.losses.subarray(from, from + this.motionCount)];
    const outcomes = [...this.outcomes.subarray(from, from + this.motionCount)];
    const expected = Math.min(...losses);
    const motions = losses.map((_, motion) => motion);
    const tried = motions.filter((motion) => outcomes[motion] > 0);
    return {
      losses,
      outcomes,
      expected,
      effective: tried.filter((motion) => losses[motion] <= expected),
      ineffective: tried.filter((motion) => losses[motion] > expected),
      unexplored: motions.filter((motion) => outcomes[motion] === 0),
    };
  }

  best(number) {
    const { losses, outcomes } = this.explain(number);
    let best = -1;
    losses.forEach((loss, motion) => {
      if (outcomes[motion] > 0 && (best < 0 || loss < losses[best])) best = motion;
    });
    return best < 0 ? null : { motion: best, times: outcomes[best] };
  }

  /** E_S of a situation. */
  expected(number) {
    const from = this.moment * this.size + number * this.motionCount;
    let least = Infinity;
    for (let i = from; i < from + this.motionCount; ++i) least = Math.min(least, this.losses[i]);
    return least;
  }
}
