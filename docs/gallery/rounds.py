import devlearn
from devlearn import plots

trial = devlearn.Trial(devlearn.World.load("paper"), seed=3)
trial.free_learning(10_000)
paths = trial.path_learning(rounds=400)
shortest = devlearn.shortest_path(trial.robot).steps
plots.save(plots.plot_rounds(paths, shortest=shortest), "rounds.png")
