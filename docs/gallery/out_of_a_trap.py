import devlearn
from devlearn import plots

world = devlearn.World.load("u_trap")
trial = devlearn.Trial(world, devlearn.TrialConfig.adaptive(), seed=1)
paths = trial.path_learning(rounds=200)

ax = plots.plot_trajectory(paths, entry=0, by=None, color="#e69f00", title=False)
plots.plot_trajectory(paths, ax=ax, entry=-1, by=None, world=False, title=False)
plots.save(ax, "out_of_a_trap.png")
