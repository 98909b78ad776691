// The paper's learner once more: the laws by which a situation's lists develop (Eq. 9-17) and by
// which it chooses (Eq. 5 and 7), equal to devlearn::Learner to the bit.

/** e^x by devlearn's own fixed operations, which agree on every machine. */
function exponential(x) {
  if (Number.isNaN(x)) return x;
  if (x > 709.79) return Infinity;
  if (x < -745.2) return 0;
  const k = Math.floor(x * 1.44269504088896340736 + 0.5);
  const high = x - k * 0.6931471803691238; // ln 2 in two parts
  const low = k * 1.9082149292705877e-10;
  const r = high - low;
  const lost = high - r - low;
  const coefficients = [
    6227020800, 479001600, 39916800, 3628800, 362880, 40320, 5040, 720, 120, 24, 6, 2,
  ];
  let sum = 1 / coefficients[0];
  for (let i = 1; i < coefficients.length; ++i) sum = sum * r + 1 / coefficients[i];
  const half = Math.trunc(k / 2); // 2^k may be no number where its product is
  return (1 + (r + (r * r * sum + lost))) * 2 ** half * 2 ** (k - half);
}

const EVENTS = ["nothing", "extension", "rejection", "orientation", "abandonment"];

/** Lists, orientations and counts of all situations, which are numbered from 0. */
class Learner {
  constructor(config, situations) {
    const motions = (this.motionCount = config.motion_count);
    this.config = config;
    this.state = {
      sizes: new Uint16Array(2 * situations), // n_i, n-bar_i
      orientation: new Float64Array(motions * situations), // o_ij of M_i
      times: new Uint32Array(motions * situations), // n_ij of M_i
      motions: Uint16Array.from({ length: motions * situations }, (_, i) => i % motions),
      met: new Uint8Array(situations),
      counts: new Float64Array(2), // NUM_RM, NUM_M
    };
  }

  /** What a learner's snapshot holds, of its first situations. */
  load({ effective_count, ineffective_count, motions, orientation, times_learned }) {
    const { state, motionCount } = this;
    let from = 0;
    effective_count.forEach((n, s) => {
      state.sizes[2 * s] = n;
      state.sizes[2 * s + 1] = ineffective_count[s];
      state.orientation.set(orientation.subarray(from, from + n), s * motionCount);
      state.times.set(times_learned.subarray(from, from + n), s * motionCount);
      from += n;
      state.counts[0] += n + ineffective_count[s];
      state.counts[1] += n;
    });
    state.motions.set(motions);
    state.met.fill(1, 0, effective_count.length);
  }

  copy() {
    return Object.fromEntries(Object.entries(this.state).map(([name, of]) => [name, of.slice()]));
  }
  restore(copy) {
    for (const [name, of] of Object.entries(copy)) this.state[name].set(of);
  }

  /** Steps 4 and 5: what one outcome changes. Gives [event, motions reduced]. */
  develop(situation, motion, smf) {
    const { sizes, motions, times, counts, met } = this.state;
    const first = situation * this.motionCount;
    const n = sizes[2 * situation];
    const tried = n + sizes[2 * situation + 1];
    const place = motions.indexOf(motion, first) - first;
    const effective = smf >= 0;
    let event = 0;
    let reduced = 0;
    met[situation] = 1;
    if (place >= tried) {
      ++counts[0];
      event = effective ? 1 : 2;
      if (effective) this.#extend(situation, place);
      else {
        move(motions, first + place, first + tried);
        ++sizes[2 * situation + 1];
      }
    } else if (place < n) {
      if (times[first + place] < 2 ** 32 - 1) ++times[first + place];
      if (!effective && this.config.on_negative === "abandon") {
        event = 4;
        this.#removeEffective(situation, place);
        this.#normalise(situation);
      } else {
        event = 3;
        if (n > 1) {
          this.#orient(situation, place, Math.max(-1, 1 - exponential(-this.config.eta * smf)));
          reduced = this.#reduce(situation);
        }
      }
    } else if (effective && this.config.when_exhausted === "retry") {
      event = 1;
      --sizes[2 * situation + 1];
      this.#extend(situation, place);
    }
    counts[1] += sizes[2 * situation] - n;
    return [event, reduced];
  }

  // Eq. 10-13
  #extend(situation, place) {
    const { sizes, orientation, times, motions } = this.state;
    const first = situation * this.motionCount;
    const n = sizes[2 * situation]++;
    move(motions, first + place, first + n);
    for (let j = first; j < first + n; ++j) orientation[j] *= n / (n + 1);
    orientation[first + n] = 1 / (n + 1);
    times[first + n] = 1;
  }

  // Eq. 9, whose 1 is the sum of the orientations
  #orient(situation, place, d) {
    const { sizes, orientation } = this.state;
    const first = situation * this.motionCount;
    const end = first + sizes[2 * situation];
    const one = sum(orientation, first, end);
    const change = orientation[first + place] * d;
    orientation[first + place] += change;
    for (let j = first; j < end; ++j) orientation[j] /= one + change;
  }

  // Eq. 14-17
  #reduce(situation) {
    const { sizes, orientation } = this.state;
    const first = situation * this.motionCount;
    const before = sizes[2 * situation];
    const threshold = 1 / (3 * before);
    for (let j = 0; j < sizes[2 * situation]; ) {
      if (orientation[first + j] < threshold) this.#removeEffective(situation, j);
      else ++j;
    }
    const reduced = before - sizes[2 * situation];
    if (reduced > 0) this.#normalise(situation);
    return reduced;
  }

  #removeEffective(situation, place) {
    const { sizes, orientation, times, motions } = this.state;
    const first = situation * this.motionCount;
    const last = first + sizes[2 * situation] - 1;
    move(motions, first + place, last + sizes[2 * situation + 1]);
    move(orientation, first + place, last);
    move(times, first + place, last);
    --sizes[2 * situation];
    ++sizes[2 * situation + 1];
  }

  #normalise(situation) {
    const { sizes, orientation } = this.state;
    const first = situation * this.motionCount;
    const end = first + sizes[2 * situation];
    const all = sum(orientation, first, end);
    for (let j = first; j < end; ++j) orientation[j] /= all;
  }

  /** What a situation holds, and by which chances each motion would be chosen there (Eq. 5, 7). */
  explain(situation) {
    const { sizes, orientation, times, motions } = this.state;
    const { sigma, c1, c2 } = this.config;
    const first = situation * this.motionCount;
    const n = sizes[2 * situation];
    const tried = n + sizes[2 * situation + 1];
    const effective = [...motions.subarray(first, first + n)];
    const why = {
      effective,
      ineffective: [...motions.subarray(first + n, first + tried)],
      unexplored: [...motions.subarray(first + tried, first + this.motionCount)],
      orientation: [...orientation.subarray(first, first + n)],
      times: [...times.subarray(first, first + n)],
    };
    const draws = n + this.motionCount - tried;
    why.curiosity = why.times.map((count) => 1 / (1 + exponential(c1 * (count - c2))));
    why.opPlain = why.orientation.map((o) => sigma * o);
    why.opCurious = why.orientation.map((o, j) => sigma * o + (1 - sigma) * why.curiosity[j]);
    // Where the curiosity about each is active, this one wins; the first among equals.
    why.winner = effective.map((_, k) => {
      const op = why.opPlain.map((plain, j) => (j === k ? why.opCurious[j] : plain));
      return effective[op.indexOf(Math.max(...op))];
    });
    why.explore = draws ? (draws - n) / draws : 0;
    why.exploit = draws ? n / draws : 0;
    why.exhausted = draws ? 0 : 1;
    why.probability = Array.from({ length: this.motionCount }, (_, motion) => {
      if (!draws) return 1 / this.motionCount;
      const wins = why.winner.filter((winner) => winner === motion).length;
      return (wins + (why.unexplored.includes(motion) ? 1 : 0)) / draws;
    });
    return why;
  }

  /** Whether a situation was experienced. */
  met(situation) {
    return this.state.met[situation] > 0;
  }

  /** The effective motion of highest orientation, its orientation and count; null for none. */
  best(situation) {
    const { sizes, orientation, times, motions } = this.state;
    const first = situation * this.motionCount;
    const n = sizes[2 * situation];
    if (n === 0) return null;
    let best = first;
    for (let j = first + 1; j < first + n; ++j) if (orientation[j] > orientation[best]) best = j;
    return { motion: motions[best], times: times[best], orientation: orientation[best] };
  }
}

/** The value at `from` goes to `to`; those between move up or down by one. */
function move(values, from, to) {
  const carried = values[from];
  if (from < to) values.copyWithin(from, from + 1, to + 1);
  else values.copyWithin(to + 1, to, from);
  values[to] = carried;
}

/** Added in order, as C++ does. */
function sum(values, first, end) {
  let total = 0;
  for (let j = first; j < end; ++j) total += values[j];
  return total;
}

/** The learner at any step of a record: run once from the first, then on from the state kept before. */
class Replay {
  static #MOST_BYTES = 64e6;

  /** steps: situation, motion and smf, a value a step each. */
  constructor(learner, steps) {
    this.learner = learner;
    this.steps = steps;
    const count = steps.motion.length;
    const start = learner.copy();
    const size = Object.values(start).reduce((bytes, of) => bytes + of.byteLength, 0);
    const most = Math.max(2, Math.min(64, Math.floor(Replay.#MOST_BYTES / size)));
    this.stride = Math.max(1, Math.ceil(count / most));
    this.kept = [start];
    this.made = 0;
    this.event = new Uint8Array(count);
    this.reduced = new Uint16Array(count);
    this.explored = new Float64Array(count + 1).fill(learner.state.counts[0], 0, 1);
    this.effective = new Float64Array(count + 1).fill(learner.state.counts[1], 0, 1);
    for (let i = 0; i < count; ++i) {
      [this.event[i], this.reduced[i]] = this.#step();
      [this.explored[i + 1], this.effective[i + 1]] = learner.state.counts;
      if (this.made % this.stride === 0) this.kept.push(learner.copy());
    }
  }

  #step() {
    const { situation, motion, smf } = this.steps;
    const i = this.made++;
    return this.learner.develop(situation[i], motion[i], smf[i]);
  }

  /** The learner after so many steps. */
  to(step) {
    if (step < this.made || step - this.made > this.stride) {
      const kept = Math.floor(step / this.stride);
      this.learner.restore(this.kept[kept]);
      this.made = kept * this.stride;
    }
    while (this.made < step) this.#step();
    return this.learner;
  }

  /** What a situation held before a step; the learner stays where it is. */
  before(step, situation) {
    const now = this.made;
    const why = this.to(step).explain(situation);
    this.to(now);
    return why;
  }
}
