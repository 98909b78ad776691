import devlearn
from devlearn import plots

trial = devlearn.Trial(devlearn.World.load("paper"), seed=3)
trial.free_learning(10_000)
paths = trial.path_learning(rounds=400)

ax = plots.plot_sef(trial.world)
plots.plot_trajectory(paths, ax=ax, entry=-1, by=None, world=False, title=False)
plots.save(ax, "settled_path.png")
