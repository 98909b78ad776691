import devlearn
from devlearn import plots

trial = devlearn.Trial(devlearn.World.load("paper"), seed=3)
plots.save(plots.plot_episodes(trial.free_learning(30)), "first_steps.png")
