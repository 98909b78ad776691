import devlearn
from devlearn import plots

trial = devlearn.Trial(devlearn.World.load("paper"), seed=3)
plots.save(plots.plot_counts(trial.free_learning(10_000)), "counts.png")
