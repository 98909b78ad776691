// Where the learner prefers to go: an arrow for each cell that it knows.

const FEW_STEPS = 500; // after which only the cells they were in are looked at again

/** As analysis.preference_field: of each cell the mean direction of the preferred motions, each
 * weighted by how often it was learned. */
class Preferences {
  constructor(run) {
    this.run = run;
    this.known = Boolean(run.grid && (run.replay || run.adaptive));
    this.cells = new Map();
    if (!this.known) return;
    run.ids.forEach((_, number) => {
      const cell = run.cellOf(number);
      if (!cell) return;
      if (!this.cells.has(cell.cell)) this.cells.set(cell.cell, { ...cell, members: [] });
      this.cells.get(cell.cell).members.push({ number, heading: cell.heading });
    });
    this.cellOf = run.ids.map((_, number) => this.cells.get(run.cellOf(number)?.cell));
  }

  /** The arrows at a frame: x and y of the cell, u and v of length at most 1, and times learned. */
  at(frame) {
    const { run } = this;
    if (!this.known) return [];
    const made = run.stepsTo(frame);
    if (run.adaptive) {
      const { moment } = run.adaptive.to(made);
      if (moment !== this.moment) this.#lookAt(this.cells.values());
      this.moment = moment;
    } else {
      run.replay.to(made);
      const few = made >= this.made && made - this.made < FEW_STEPS;
      const met = few ? run.situation.subarray(this.made, made) : [];
      this.#lookAt(few ? new Set(Array.from(met, (number) => this.cellOf[number])) : this.cells.values());
      this.made = made;
    }
    return [...this.cells.values()].filter((cell) => cell.times !== undefined);
  }

  #lookAt(cells) {
    for (const cell of cells) {
      if (!cell) continue;
      const [sums, met] = this.#sumsOf(cell.members);
      const times = Math.max(1, sums.times);
      Object.assign(cell, { u: sums.u / times, v: sums.v / times, times: met ? sums.times : undefined });
    }
  }

  #sumsOf(members) {
    const { run } = this;
    const learner = run.adaptive ?? run.replay.learner;
    const sums = { u: 0, v: 0, times: 0 };
    let anyMet = false;
    for (const { number, heading } of members) {
      if (!learner.met(number)) continue;
      anyMet = true;
      const best = learner.best(number);
      if (!best) continue;
      const way = ((heading + run.robot.steering_angles[best.motion]) * Math.PI) / 180;
      sums.u += best.times * Math.cos(way);
      sums.v += best.times * Math.sin(way);
      sums.times += best.times;
    }
    return [sums, anyMet];
  }
}
