import devlearn
import matplotlib.pyplot as plt
import numpy as np
from devlearn import plots

trial = devlearn.Trial(devlearn.World.load("paper"), seed=3)
trial.free_learning(10_000)
why = trial.learner.explain(trial.grid.situation(4.1, 4.1, 60))

ax = plt.figure(figsize=(7, 4), layout="constrained").add_subplot()
place = np.arange(len(why.op_plain))
ax.bar(place - 0.2, why.op_plain, 0.4, label="another one is the curious one")
ax.bar(place + 0.2, why.op_curious, 0.4, label="curious about it")
angles = np.array(trial.config.robot.steering_angles)[why.memory.effective]
ax.set_xticks(
    place, [f"{angle:g}°\nlearned {n}" for angle, n in zip(angles, why.memory.times_learned)]
)
ax.set(ylabel="op, Eq. 7", title=f"explores in {why.explore:.0%}; else the highest wins")
ax.legend()
plots.save(ax, "why.png")
