import devlearn
import matplotlib.pyplot as plt
from devlearn import plots

figure, axes = plt.subplots(1, 3, figsize=(9, 3.2), layout="constrained")
for ax, kind in zip(axes, ("clutter", "corridors", "rooms")):
    plots.plot_world(devlearn.World.random(kind, seed=1), ax=ax, sonar=False, legend=False)
    ax.set_title(kind)
plots.save(axes[0], "random_worlds.png")
