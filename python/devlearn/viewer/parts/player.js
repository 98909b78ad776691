// The page: time, keys, pointers, and what they change.

const SPEEDS = [1, 5, 20, 60, 250, 1000, 5000, 25000]; // frames a second
const MOST_HEADINGS = 36; // of a cell, to choose from
const PANEL_EVERY = 70; // ms between two changes of the panel while playing
const RAMPS = {
  light: [[176, 190, 212], [214, 224, 232], [240, 243, 236], [255, 247, 214]],
  dark: [[16, 20, 30], [24, 36, 54], [38, 60, 78], [74, 92, 92]],
};

class Player {
  constructor(run) {
    this.run = run;
    this.place = new Place(run);
    this.ground = new Ground(run);
    this.stage = new Stage(byId("stage"), run, this.place, this.ground);
    this.panel = new Panel(run);
    this.frame = 0;
    this.playing = false;
    this.speed = SPEEDS[3];
    this.pointer = null; // { x, y } in the arena
    this.pinned = false;
    this.heading = null; // of the cell pointed at; null: the robot's
    this.layers = {
      ground: this.ground.kinds.at(-1),
      paths: true,
      arrows: this.stage.preferences.known,
      sonars: true,
    };
    this.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
    this.charts = this.#makeCharts();
    this.#fillPage();
    listen(this);
    this.setTheme(this.theme);
    new ResizeObserver(() => this.#resize()).observe(byId("arena"));
  }

  // --- what does not change

  #makeCharts() {
    const { run } = this;
    const charts = [];
    const part = (frame) => frame / Math.max(1, run.frames - 1);
    const goTo = (at) => this.show(Math.round(at * (run.frames - 1)));
    if (run.hasSteps) {
      charts.push(new Chart(byId("counts"), { draw: drawCounts(run), cursor: part, goTo }));
      const margin = { left: 0, right: 0, top: 0, bottom: 0 };
      charts.push(new Chart(byId("kinds"), { draw: drawKinds(run), cursor: part, goTo, margin }));
    }
    if (run.rounds > 0) {
      const last = Math.max(1, run.rounds - 1);
      charts.push(
        new Chart(byId("rounds"), {
          draw: drawRounds(run),
          cursor: (frame) => (run.hasSteps ? run.roundOf(frame) / last : -1),
          goTo: (at) => run.hasSteps && this.show(run.firstFrame[Math.round(at * last)]),
        }),
      );
    }
    return charts;
  }

  #fillPage() {
    const { run } = this;
    byId("title").textContent = run.world.name || "A world without a name";
    byId("subtitle").textContent = this.#subtitle();
    byId("growth").hidden = !run.hasSteps;
    byId("lengths").hidden = run.rounds < 2;
    byId("transport").hidden = run.frames < 2;
    byId("kinds").hidden = !run.hasSteps;
    byId("previous").hidden = byId("next").hidden = run.rounds < 2;
    byId("scrub").max = run.frames - 1;
    byId("speed").append(
      ...SPEEDS.map((speed) => made("option", { value: speed, text: `${thousands(speed)} steps/s` })),
    );
    byId("speed").value = this.speed;
    byId("notes").append(...run.notes.map((note) => made("p", { text: note })));
    byId("keys").append(
      made("h2", { text: "Keys" }),
      made("dl", {
        children: KEYS.flatMap(([key, what]) => [made("dt", { text: key }), made("dd", { text: what })]),
      }),
      made("p", { text: "Point at a cell to see what the learner knows there; click or tap to hold it." }),
    );
    const { provenance } = run;
    if (provenance) {
      byId("provenance").textContent =
        `devlearn ${provenance.devlearn ?? "?"} (${provenance.commit ?? "?"}), seed ` +
        `${provenance.seed ?? "?"}, agent ${provenance.agent ?? "?"}, world ${provenance.hash.slice(0, 12)}`;
    }
    this.#fillLegend();
  }

  #subtitle() {
    const { run } = this;
    if (run.shows === "world") return "A world. Point anywhere to see its SEF, and what sonars hear there.";
    const rounds =
      `${thousands(run.allRounds)} ${run.allRounds === 1 ? "round" : "rounds"}, ` +
      `${thousands(run.allArrived)} of them arrived`;
    if (!run.hasSteps) return rounds;
    const thinned = run.thinned;
    const left = [];
    if (thinned?.rounds > 1) left.push(`one round in ${thousands(thinned.rounds)}`);
    if (thinned?.steps > 1) left.push(`one step in ${thousands(thinned.steps)}`);
    const shown = left.length ? `. Thinned to be shown: ${left.join(", ")}` : "";
    return `${thousands(run.total)} steps; ${rounds}${shown}`;
  }

  #fillLegend() {
    const { run } = this;
    const legend = byId("legend");
    if (run.hasSteps) {
      const counts = run.kinds.map(() => 0);
      run.kind.forEach((kind) => ++counts[kind]);
      const kinds = run.kinds.filter((_, kind) => counts[kind] > 0);
      legend.append(
        made("div", {
          className: "keys",
          children: kinds.map((kind) =>
            made("span", {
              title: KIND_MEANINGS[kind],
              children: [
                made("span", { className: `key ${kind}` }),
                `${kind} ${percent(counts[run.kinds.indexOf(kind)] / run.steps)}`,
              ],
            }),
          ),
        }),
      );
    }
    const toggle = (name, text, usable) => {
      if (!usable) return [];
      const button = made("button", { type: "button", text, id: `layer-${name}` });
      button.addEventListener("click", () => this.setLayers({ [name]: !this.layers[name] }));
      return [button];
    };
    const grounds = made("select", {
      id: "ground",
      ariaLabel: "ground",
      children: this.ground.kinds.map((kind) =>
        made("option", { value: kind, text: kind === "none" ? "no ground" : `ground: ${kind}` }),
      ),
    });
    grounds.addEventListener("change", () => this.setLayers({ ground: grounds.value }));
    legend.append(
      made("div", {
        className: "buttons",
        children: [
          ...(this.ground.kinds.length > 1 ? [grounds, made("span", { id: "scale" })] : []),
          ...toggle("arrows", "arrows", this.stage.preferences.known),
          ...toggle("sonars", "sonars", true),
          ...toggle("paths", "earlier paths", run.rounds > 1),
        ],
      }),
    );
  }

  // --- how it is shown

  /** Nearer by a factor; around a point, else the robot. */
  zoomBy(factor, around = this.#pose()) {
    this.stage.zoomBy(factor, around);
    byId("stage").style.touchAction = this.stage.zoom > 1 ? "none" : "";
    this.render();
  }

  nextGround() {
    const { kinds } = this.ground;
    return kinds[(kinds.indexOf(this.layers.ground) + 1) % kinds.length];
  }

  stepBy(frames) {
    this.play(false);
    this.show(this.frame + frames);
  }

  /** To the beginning of this round, or of one before or after. */
  roundBy(rounds) {
    const { run } = this;
    if (!run.hasSteps) return;
    const round = run.roundOf(this.frame);
    const within = this.frame > run.firstFrame[round];
    const to = round + rounds + (rounds < 0 && within ? 1 : 0);
    this.show(run.firstFrame[Math.max(0, Math.min(run.rounds - 1, to))]);
  }

  setSpeed(change) {
    const next = SPEEDS.indexOf(this.speed) + change;
    this.speed = SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, next))];
    byId("speed").value = this.speed;
  }

  setLayers(layers) {
    Object.assign(this.layers, layers);
    for (const name of ["arrows", "sonars", "paths"]) {
      byId(`layer-${name}`)?.setAttribute("aria-pressed", this.layers[name]);
    }
    if (byId("ground")) this.#showScale();
    this.render();
  }

  /** What the colours of the ground mean. */
  #showScale() {
    const kind = this.layers.ground;
    byId("ground").value = kind;
    byId("scale").hidden = kind === "none";
    if (kind === "none") return;
    const { low, high } = this.ground.range(kind);
    const bar = made("span");
    bar.style.background = `linear-gradient(to right, ${RAMPS[this.theme].map((c) => `rgb(${c})`)})`;
    byId("scale").replaceChildren(plain(low, 0), bar, plain(high, 0));
  }

  setTheme(theme) {
    this.theme = theme;
    document.documentElement.dataset.theme = theme;
    const style = getComputedStyle(document.documentElement);
    const names = [...this.run.kinds, "floor", "ink", "muted", "line", "obstacle", "edge"];
    this.colours = { ramp: RAMPS[theme] };
    for (const name of [...names, "robot", "target", "touch", "sonar", "arrow"]) {
      this.colours[name] = style.getPropertyValue(`--${name}`).trim();
    }
    this.ground.key = null;
    this.#resize(true);
    this.setLayers({});
  }

  #resize(anew = false) {
    const width = byId("arena").clientWidth;
    if (!width || (!anew && width === this.width)) return;
    this.width = width;
    // As wide as there is room for, but not higher than what the window leaves.
    const high = Math.max(260, innerHeight - (innerWidth < 900 ? 190 : 250));
    const fits = ((high - 2 * MARGIN) * this.place.width) / this.place.height + 2 * MARGIN;
    this.stage.resize(Math.min(width, fits), this.colours);
    this.charts.forEach((chart) => chart.resize(this.colours));
    this.render();
  }

  // --- the cell pointed at

  /** A click or a tap: it is held, or let go where it was held. */
  hold(point) {
    const again = this.pinned && this.#same(this.pointer, point);
    this.pinned = !again;
    this.point(again ? null : point);
  }

  letGo() {
    this.pinned = false;
    this.point(null);
  }

  #same(a, b) {
    const { run } = this;
    if (!run.grid) return Math.hypot(a.x - b.x, a.y - b.y) < run.robot.radius;
    return run.idAt({ ...a, heading: 0 }) === run.idAt({ ...b, heading: 0 });
  }

  point(pointer) {
    this.pointer = pointer;
    if (!pointer) this.heading = null;
    this.render();
  }

  /** To another heading of the cell pointed at. */
  turn(bins) {
    const { run } = this;
    if (!this.pointer) return;
    const heading = this.#pointedHeading() + (bins * 360) / (run.grid?.headings ?? 24);
    this.heading = ((heading % 360) + 360) % 360;
    this.pinned = true;
    this.render();
  }

  // Of the cell pointed at that chosen, else the robot's if it was met there, else that met last.
  #pointedHeading() {
    const { run, pointer } = this;
    const { heading } = run.poseAt(this.frame);
    if (this.heading !== null || !run.grid || !run.hasSteps) return this.heading ?? heading;
    const made_ = run.stepsTo(this.frame);
    const id = run.idAt({ ...pointer, heading });
    const first = id - (id % run.grid.headings);
    let last = this.#lastIn(id, made_) >= 0 ? Infinity : -1;
    let found = heading;
    for (let bin = 0; bin < run.grid.headings; ++bin) {
      const step = this.#lastIn(first + bin, made_);
      if (step > last) [last, found] = [step, (bin * 360) / run.grid.headings];
    }
    return found;
  }

  // The last step before `made_` in the situation with an id; -1 for none.
  #lastIn(id, made_) {
    const number = this.run.numberOf.get(id);
    return number === undefined ? -1 : this.run.lastIn(number, made_);
  }

  /** The situation that the panel tells of: that pointed at, or the robot's own. */
  #pointed() {
    const { run } = this;
    if (this.pointer && run.grid) {
      const id = run.idAt({ ...this.pointer, heading: this.#pointedHeading() });
      return { id, number: run.numberOf.get(id), here: false };
    }
    const made_ = run.stepsTo(this.frame);
    const atStart = this.frame === run.firstFrame[run.roundOf(this.frame)];
    const number = run.situation[atStart ? Math.min(made_, run.steps - 1) : made_ - 1];
    return { id: run.ids[number], number, here: !atStart };
  }

  #showReasons() {
    const { run } = this;
    const sef = this.#sefThere();
    byId("hint").textContent = sef && `SEF at the pointer ${sef}`;
    byId("reasons").hidden = !run.steps;
    if (!run.steps) return;
    const pointed = this.#pointed();
    this.panel.explain(pointed, this.frame);
    this.#showHeadings(pointed.id);
  }

  /** SEF at the pointer, as text; none where it is not pointed or SEF is not known. */
  #sefThere() {
    const { run, pointer } = this;
    return pointer && run.field ? plain(this.ground.sefAt(pointer.x, pointer.y), 2) : "";
  }

  /** The headings of a situation's cell, to choose from; those met are seen best. */
  #showHeadings(id) {
    const { run } = this;
    const bins = run.grid?.headings ?? 0;
    const cell = run.cellOfId(id);
    byId("headings").hidden = !cell || bins > MOST_HEADINGS;
    if (byId("headings").hidden) return;
    const first = id - (id % bins);
    const made_ = run.stepsTo(this.frame);
    const buttons = Array.from({ length: bins }, (_, bin) => {
      const heading = (bin * 360) / bins;
      const arrow = made("span", { className: "way", text: "\u2192" });
      arrow.style.transform = `rotate(${-heading}deg)`;
      const button = made("button", {
        type: "button",
        title: `heading ${heading}\u00b0`,
        className: this.#lastIn(first + bin, made_) >= 0 ? "known" : "",
        children: [arrow],
      });
      button.setAttribute("aria-pressed", first + bin === id);
      button.addEventListener("click", () => {
        this.pinned = true;
        this.heading = heading;
        this.point(this.pointer ?? cell);
      });
      return button;
    });
    byId("headings").replaceChildren(...buttons);
  }

  // --- time

  play(playing) {
    if (playing === this.playing) return;
    this.playing = playing;
    byId("play").textContent = playing ? "\u275a\u275a" : "\u25b6";
    if (!playing) return this.render();
    if (this.frame >= this.run.frames - 1) this.show(0);
    this.at = this.frame;
    this.before = performance.now();
    requestAnimationFrame((now) => this.#tick(now));
  }

  #tick(now) {
    if (!this.playing) return;
    this.at += (Math.max(0, now - this.before) / 1000) * this.speed;
    this.before = now;
    const frame = Math.min(this.run.frames - 1, Math.floor(this.at));
    if (frame !== this.frame) this.#go(frame, now);
    if (frame === this.run.frames - 1) return this.play(false);
    requestAnimationFrame((next) => this.#tick(next));
  }

  show(frame) {
    this.at = Math.max(0, Math.min(this.run.frames - 1, Math.round(frame)));
    this.#go(this.at);
  }

  #go(frame, now = Infinity) {
    this.frame = frame;
    this.stage.keepInView(this.run.poseAt(frame));
    byId("scrub").value = frame;
    const quick = now - (this.told ?? -Infinity) < PANEL_EVERY;
    if (!quick) this.told = Number.isFinite(now) ? now : performance.now();
    this.#drawAll(!quick);
  }

  render() {
    this.#drawAll(true);
  }

  #drawAll(told) {
    if (!this.stage.view) return;
    const { run, frame } = this;
    const pointed =
      this.pointer && run.grid && run.hasSteps ? run.cellOfId(this.#pointed().id) : null;
    const pose = this.#pose();
    this.stage.draw({ frame, pose, layers: this.layers, pointed });
    this.charts.forEach((chart) => chart.draw(frame));
    this.#sayWhen();
    if (!told) return;
    this.panel.now(frame, pose, run.hasSteps ? "" : this.#sefThere());
    this.#showReasons();
  }

  /** Where the robot is; in a world alone, where it is pointed to. */
  #pose() {
    const pose = this.run.poseAt(this.frame);
    if (this.run.hasSteps || !this.pointer) return pose;
    return { ...pose, ...this.pointer, heading: this.heading ?? pose.heading };
  }

  #sayWhen() {
    const { run, frame } = this;
    if (!run.hasSteps) {
      byId("round").textContent = "The robot";
      byId("badge").textContent = run.frames > 1 ? `${run.timeAt(frame).toFixed(1)} s` : "";
      return;
    }
    const { round, stepOfRound, stepsOfRound } = this.state();
    const text = `Round ${thousands(round)}, step ${thousands(stepOfRound)} of ${thousands(stepsOfRound)}`;
    byId("round").textContent = text;
    byId("badge").textContent = text;
  }

  /** Where it is, as plain values. */
  state() {
    const { run, frame } = this;
    const told = {
      frame,
      frames: run.frames,
      step: run.stepAt(frame),
      ...run.poseAt(frame),
      time: run.timeAt(frame),
      playing: this.playing,
      speed: this.speed,
      theme: this.theme,
      zoom: this.stage.zoom,
      layers: { ...this.layers },
      notes: run.notes,
    };
    if (!run.hasSteps) return told;
    const index = run.roundOf(frame);
    const made_ = run.stepsTo(frame);
    const atStart = frame === run.firstFrame[index];
    const [explored, effective] = run.countsAt(frame);
    return {
      ...told,
      steps: run.total,
      round: run.roundNumber[index],
      stepOfRound: run.stepAt(frame) - run.firstStep[index],
      stepsOfRound: run.roundSteps[index],
      explored,
      effective,
      learner: run.replay ? "paper" : run.adaptive ? "adaptive" : null,
      ...(run.trueSituation && made_ < run.steps
        ? {
            believedSituation: run.ids[run.situation[made_]],
            trueSituation: run.ids[run.trueSituation[made_]],
          }
        : {}),
      ...(atStart
        ? {}
        : {
            situation: run.ids[run.situation[made_ - 1]],
            motion: run.motion[made_ - 1],
            kind: run.kinds[run.kind[made_ - 1]],
            event: run.events[run.event[made_ - 1]],
          }),
    };
  }

  /** What the learner knows of a situation, by its id, at this frame; null where it is not told. */
  situation(id) {
    const { run } = this;
    const number = run.numberOf?.get(id);
    if (number === undefined) return null;
    if (run.replay) return run.replay.before(run.stepsTo(this.frame), number);
    return run.adaptive ? run.adaptive.to(run.stepAt(this.frame)).explain(number) : null;
  }
}

async function start() {
  const run = new Run(await unpack(byId("data").textContent));
  const player = new Player(run);
  window.devlearn = {
    goTo: (step) => player.show(run.frameOf(step)),
    state: () => player.state(),
    situation: (id) => player.situation(id),
    echoes: () => Array.from(player.stage.echoes(player.frame)),
    pixel: ({ x, y }) => player.stage.pixelAt(x, y),
    preferences: () => player.stage.preferences.at(player.frame),
    movers: (time) => player.place.movers.map((mover) => mover.placeAt(time)),
    play: () => player.play(true),
    stop: () => player.play(false),
    show: (layers) => player.setLayers(layers),
  };
  document.documentElement.dataset.ready = "";
}

start().catch((error) => {
  byId("notes").textContent = `This page could not be shown: ${error.message}. A browser of 2023 or later is needed.`;
  throw error;
});
