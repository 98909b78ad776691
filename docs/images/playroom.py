"""Measures what docs/who_is_who/salient_events.md tells of the playroom, and draws playroom.png.

    python docs/images/playroom.py

The criteria stand on that page, and were written there before this was run.
"""

from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import matplotlib as mpl
import numpy as np
from devlearn import RandomAgent, Trial, World
from devlearn.agents import QLearning, SalientEvents
from devlearn.plots.panels import png
from devlearn.plots.style import BLUE, GREEN, ORANGE, STYLE, VERMILLION
from devlearn.tasks import Playroom, run
from matplotlib.figure import Figure

SEEDS = range(1, 11)
SPAN, SPANS = 100_000, 100
SHORT, LIMIT = 4_000_000, 50_000  # with the reward
SKILLS = {"light_on": ORANGE, "music_on": BLUE, "bell_rings": GREEN, "monkey_cries": VERMILLION}
PLAY = Playroom.Config(reward=0.0, ending=False)


def counts_of_spans(agent, seed, spans):
    """How often each event came in each span of a life in the room without reward."""
    room, counts = Playroom(PLAY), []
    for i in range(spans):
        run(room, agent, 1, seed=seed, first=i, step_limit=SPAN)
        counts.append([room.counts[event] for event in SKILLS])
    return counts


def nested(agent, seed, steps=20_000):
    """The share of the steps of the monkey's option in which another option runs within it."""
    room, monkey = Playroom(PLAY), Playroom.EVENTS.index("monkey_cries")
    room.begin(seed)
    agent.begin_round()
    depths = []
    for _ in range(steps):
        seen = room.observation()
        motion = agent.choose(seen).motion
        running = agent.explain(seen.situation).running
        if running[:1] == [monkey]:
            depths.append(len(running))
        agent.observe(room.step(motion))
    return np.mean(np.array(depths) > 1) if depths else np.nan


def played(seed):
    """A life of play, and what runs within the monkey's option at its end."""
    agent = SalientEvents(seed=seed)
    return counts_of_spans(agent, seed, SPANS), nested(agent, seed)


def steps_a_cry(make, seed):
    """Steps per cry in the last half of a life in which cries are rewarded and end episodes."""
    room, agent, steps, cries, total, i = Playroom(), make(seed), 0, 0, 0, 0
    while total < SHORT:
        episode = run(room, agent, 1, seed=seed, first=i, step_limit=LIMIT)[0]
        total, i = total + int(episode["steps"]), i + 1
        if total > SHORT / 2:
            steps, cries = steps + int(episode["steps"]), cries + int(episode["succeeded"])
    return steps / max(cries, 1)


def learner(seed, tau=0.5):
    """With intrinsic reward, or without."""
    return SalientEvents(SalientEvents.Config(tau=tau), seed)


def q_learner(seed):
    """Without options, too."""
    return QLearning(QLearning.Config(alpha=0.1, gamma=0.9, epsilon=0.3), seed)


def late_steps(make, seed):
    """Mean steps of the last 50 of 300 rounds in the paper's world."""
    paths = Trial(World.load("paper"), agent=make(seed)).path_learning(300, step_limit=10_000)
    return paths.rounds["steps"][-50:].mean()


def draw(spans, by_chance):
    """Steps between events over time: medians of the runs, and their 10th to 90th percentiles."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7.0, 3.0), layout="constrained")
        axes = figure.subplots()
        time = (np.arange(SPANS) + 0.5) * SPAN / 1e6
        for skill, (name, colour) in enumerate(SKILLS.items()):
            between = SPAN / np.maximum(spans[:, :, skill], 0.5)  # 2 spans where none came
            low, median, high = np.percentile(between, (10, 50, 90), axis=0)
            axes.fill_between(time, low, high, color=colour, alpha=0.2, linewidth=0)
            axes.plot(time, median, color=colour, label=name.replace("_", " "))
            axes.axhline(by_chance[skill], color=colour, linestyle=":", linewidth=1)
        axes.set(
            yscale="log", xlim=(0, SPANS * SPAN / 1e6),
            xlabel="steps [million]", ylabel="steps between events",
        )  # fmt: skip
        axes.legend(title="dotted: by chance")
        (Path(__file__).parent / "playroom.png").write_bytes(png(axes))


def main():
    """Runs it all."""
    with ProcessPoolExecutor(2) as pool:
        chance = np.array([counts_of_spans(RandomAgent(seed), seed, 10) for seed in SEEDS])
        by_chance = 10 * len(SEEDS) * SPAN / chance.sum((0, 1))
        lives = list(pool.map(played, SEEDS))
        spans = np.array([counts for counts, _ in lives])
        print("steps between events by chance:", dict(zip(SKILLS, by_chance.round())))

        mastered = SPAN / np.maximum(spans, 1e-9) <= by_chance / 10
        first = np.where(mastered.any(1), mastered.argmax(1) + 1, SPANS + 1)
        print(f"spans of {SPAN} steps until a tenth of that, a row a run:\n{first}")
        print("means:", first.mean(0), "of", SPANS)
        light, music, bell, monkey = first.T
        ordered = (np.maximum(light, music) <= bell) & (bell <= monkey)
        print("light and music, then the bell, then the monkey:", ordered.sum(), "of", len(SEEDS))
        print("reached:", mastered.any(1).sum(0))
        late = 10 * SPAN / np.maximum(spans[:, -10:].sum(1), 1e-9)
        print(f"steps between events in the last million, a row a run:\n{late.round()}")
        print("medians:", np.median(late, 0).round())
        print("others within the monkey's option:", np.round([n for _, n in lives], 2))
        draw(spans, by_chance)

        for name, make in (
            ("tau 0.5", learner),
            ("tau 0", partial(learner, tau=0.0)),
            ("QLearning", q_learner),
            ("by chance", RandomAgent),
        ):
            steps = np.array(list(pool.map(partial(steps_a_cry, make), SEEDS)))
            print(f"{name}: steps a cry {np.sort(steps).round()}, median {np.median(steps):.0f}")
        for name, make in (("SalientEvents", learner), ("by chance", RandomAgent)):
            steps = np.array(list(pool.map(partial(late_steps, make), SEEDS)))
            print(f"paper's world, {name}: {steps.mean():.0f} steps, sd {steps.std():.0f}")


if __name__ == "__main__":
    main()
