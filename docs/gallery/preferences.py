import devlearn
from devlearn import plots

trial = devlearn.Trial(devlearn.World.load("paper"), seed=3)
trial.free_learning(10_000)
trial.path_learning(rounds=400)
plots.save(plots.plot_preferences(trial), "preferences.png")
