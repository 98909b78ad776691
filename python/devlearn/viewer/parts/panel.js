// Beside the arena: what happens now, and what a situation holds and why it chose as it did.

const byId = (id) => document.getElementById(id);

/** An element with its text and its children. */
function made(tag, { text, children = [], ...rest } = {}) {
  const element = Object.assign(document.createElement(tag), rest);
  if (text !== undefined) element.textContent = text;
  element.append(...children);
  return element;
}

const percent = (part) =>
  `${part > 0 && part < 0.005 ? "< 1" : Math.round(100 * part)}\u2009%`;
const signed = (value, digits) => (value < 0 ? "\u2212" : "+") + Math.abs(value).toFixed(digits);
const plain = (value, digits) => (value < 0 ? "\u2212" : "") + Math.abs(value).toFixed(digits);
const capital = (text) => text[0].toUpperCase() + text.slice(1);

const KIND_MEANINGS = {
  explore: "a motion not tried here yet",
  exploit: "what is known as the best here",
  exhausted: "any motion: none left to try, none effective",
  unstated: "the agent gives no reason",
  habit: "as in the best round so far",
  deviation: "another than the habit's, for what it promises",
  held: "the motion of before: the situation is the same",
};

const EVENT_MEANINGS = {
  nothing: "nothing changed",
  extension: "it became effective (extension)",
  rejection: "it is ineffective (rejection)",
  orientation: "orientations changed (Eq. 9)",
  abandonment: "it was abandoned",
};

class Panel {
  constructor(run) {
    this.run = run;
    this.facts = byId("facts");
    this.why = byId("why");
  }

  /** A motion by its steering angle, with an arrow as the robot would see it. */
  motion(index) {
    const angle = this.run.robot.steering_angles[index];
    const arrow = made("span", { className: "way", text: "\u2191", ariaHidden: "true" });
    arrow.style.transform = `rotate(${-angle}deg)`;
    const name = angle === 0 ? "ahead" : `${Math.abs(angle)}\u00b0 ${angle > 0 ? "left" : "right"}`;
    return made("span", { className: "motion", children: [arrow, name] });
  }

  chip(kind) {
    return made("span", { className: `chip ${kind}`, text: kind });
  }

  // --- now

  now(frame, pose, sef) {
    const { run } = this;
    const rows = [];
    const say = (name, ...what) =>
      rows.push(made("dt", { text: name }), made("dd", { children: what }));
    if (run.hasSteps) {
      const step = run.stepsTo(frame) - 1;
      const round = run.roundOf(frame);
      const atStart = frame === run.firstFrame[round];
      if (atStart) say("Step", "put at the start of the round");
      else {
        say("Motion", this.motion(run.motion[step]), " ", this.chip(run.kinds[run.kind[step]]));
        const met = `SMF ${signed(run.smf[step], 3)}, SEF ${plain(run.sef[step], 2)}`;
        const touched = run.collided[step] ? ", touched something" : "";
        say("Outcome", `${met}${touched}; ${this.#became(step)}`);
      }
      const [explored, effective] = run.countsAt(frame);
      say("Mappings", `${thousands(explored)} explored, ${thousands(effective)} effective`);
    }
    const { x, y, heading } = pose;
    const time = run.timeAt(frame);
    const when = Number.isNaN(time) ? "" : ` at ${thousands(time)} s`;
    say("Pose", `${plain(x, 2)} m, ${plain(y, 2)} m, ${heading.toFixed(0)}\u00b0${when}`);
    if (sef) say("SEF there", sef);
    this.facts.replaceChildren(...rows);
  }

  // --- why

  /** Of a situation, by its number or its id, as far as frame: its last choice, or what it holds. */
  explain({ number, id, here }, frame) {
    const { run } = this;
    const children = [];
    const say = (text, className = "") => children.push(made("p", { text, className }));
    const cell = number === undefined ? null : run.cellOf(number);
    const name = `Situation ${number === undefined ? id : run.ids[number]}`;
    const where = cell
      ? `cell at ${plain(cell.x, 2)} m, ${plain(cell.y, 2)} m, heading ${cell.heading.toFixed(0)}\u00b0`
      : "";
    children.push(made("h3", { children: [name, made("small", { text: where })] }));
    const step = number === undefined ? -1 : run.lastIn(number, run.stepsTo(frame));
    if (step >= 0) children.push(this.#choice(step, number, here));
    else say("Not met up to now.", "quiet");
    const known = this.#known(number, step, frame);
    if (known) children.push(known);
    this.why.replaceChildren(...children);
  }

  // What it holds: as the choice found it, or as it is where it never chose.
  #known(number, step, frame) {
    const { run } = this;
    if (number === undefined) return null;
    const made_ = run.stepsTo(frame);
    if (run.replay) {
      const why = run.replay.before(step < 0 ? made_ : step, number);
      return this.#lists(why, step < 0 ? -1 : run.motion[step]);
    }
    if (!run.adaptive) return null;
    run.adaptive.to(run.stepAt(frame));
    if (!run.adaptive.met(number)) return null;
    return this.#losses(run.adaptive.explain(number), step < 0 ? -1 : run.motion[step]);
  }

  // The last choice in a situation, in words.
  #choice(step, number, here) {
    const { run } = this;
    const kind = run.kinds[run.kind[step]];
    const children = [];
    const round = run.roundOf(run.frameOf(run.thinned ? run.stepNumber[step] : step + 1));
    const when = here ? "Chosen" : `Last chosen in round ${run.roundNumber[round]}`;
    children.push(`${when}: `, this.motion(run.motion[step]), " ", this.chip(kind), ". ");
    children.push(this.#because(step, number, kind));
    const outcome = ` It met SMF ${signed(run.smf[step], 3)}: ${this.#became(step)}`;
    const reduced = run.replay?.reduced[step] ?? 0;
    children.push(outcome + (reduced ? `; ${reduced} reduced.` : "."));
    return made("p", { children });
  }

  // What became of a motion. Eq. 9 is the paper's learner's.
  #became(step) {
    const event = this.run.events[this.run.event[step]];
    if (event === "orientation" && !this.run.replay) return "what is known of it was corrected";
    return EVENT_MEANINGS[event];
  }

  #because(step, number, kind) {
    const { run } = this;
    if (!run.replay) return `${capital(KIND_MEANINGS[kind])}.`;
    const why = run.replay.before(step, number);
    const [untried, effective] = [why.unexplored.length, why.effective.length];
    if (kind === "explore") {
      const among = untried === 1 ? "the only one left" : `drawn from ${untried} not tried yet`;
      return `To explore had a chance of ${percent(why.explore)}; it was ${among}.`;
    }
    if (kind === "exploit") {
      if (effective === 1) return `The only effective one; to exploit had a chance of ${percent(why.exploit)}.`;
      const drawn = why.effective.filter((_, j) => why.winner[j] === run.motion[step]);
      if (drawn.length === effective) {
        return `It wins whichever motion's curiosity is drawn; to exploit had a chance of ${percent(why.exploit)}.`;
      }
      const names = drawn.map((motion) => this.motion(motion).textContent.slice(1)).join(" or ");
      return `Curiosity about ${names} was drawn (${drawn.length} of ${effective}), where it wins.`;
    }
    if (kind === "exhausted") return "All were tried and none is effective: drawn from all.";
    return `${capital(KIND_MEANINGS[kind])}.`;
  }

  #table(heads, rows) {
    const head = made("tr", {
      children: heads.map(([text, title]) => made("th", { text, title: title ?? "" })),
    });
    return made("table", {
      children: [made("thead", { children: [head] }), made("tbody", { children: rows })],
    });
  }

  #row(motion, list, chosen, cells) {
    const first = made("td", { children: [this.motion(motion)] });
    return made("tr", {
      className: `${list}${motion === chosen ? " chosen" : ""}`,
      children: [first, made("td", { text: list }), ...cells.map((cell) => made("td", { children: [cell] }))],
    });
  }

  #bar(part) {
    const bar = made("span", { className: "bar" });
    bar.style.width = `${Math.max(1, 34 * part)}px`;
    return made("span", { className: "barred", children: [bar, part.toFixed(2)] });
  }

  #lists(why, chosen) {
    const rows = why.effective.map((motion, j) =>
      this.#row(motion, "effective", chosen, [
        this.#bar(why.orientation[j]),
        thousands(why.times[j]),
        why.curiosity[j].toFixed(2),
        `${why.opPlain[j].toFixed(2)} \u2192 ${why.opCurious[j].toFixed(2)}`,
        percent(why.probability[motion]),
      ]),
    );
    for (const list of ["unexplored", "ineffective"]) {
      for (const motion of why[list]) {
        const chance = why.probability[motion];
        rows.push(this.#row(motion, list, chosen, ["", "", "", "", percent(chance)]));
      }
    }
    return this.#table(
      [
        ["motion"],
        ["list"],
        ["orientation", "o of Eq. 9; those of effective motions sum to 1"],
        ["learned", "how often, n"],
        ["curiosity", "c of Eq. 5"],
        ["op", "Eq. 7, without and with its curiosity"],
        ["chance", "to be chosen here"],
      ],
      rows,
    );
  }

  #losses({ losses, outcomes, expected, ...lists }, chosen) {
    const list = (motion) =>
      ["effective", "ineffective", "unexplored"].find((name) => lists[name].includes(motion));
    const rows = losses.map((loss, motion) =>
      this.#row(motion, list(motion), chosen, [plain(loss, 1), thousands(outcomes[motion])]),
    );
    const told = `as of step ${thousands(this.run.adaptive.step)}; expected loss ${plain(expected, 1)}`;
    const table = this.#table(
      [["motion"], ["list"], ["loss", "expected, on the way to the goal: q"], ["outcomes"]],
      rows,
    );
    return made("div", { children: [made("p", { className: "quiet", text: capital(told) }), table] });
  }
}
