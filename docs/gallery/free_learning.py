import devlearn
from devlearn import plots

trial = devlearn.Trial(devlearn.World.load("paper"), seed=3)
record = trial.free_learning(10_000)
plots.save(plots.plot_trajectory(record), "free_learning.png")
