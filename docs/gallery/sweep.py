import devlearn
from devlearn import plots

spec = {
    "worlds": ["paper"],
    "agents": ["paper", "adaptive", "step5"],
    "seeds": "1-5",
    "free": [],
    "rounds": 100,
}
runs = devlearn.sweep(spec, "runs.sqlite", workers=1).to_pandas()
ratios = {label: of["last_ratio"] for label, of in runs.groupby("label")}
ylabel = "last rounds / shortest path"
plots.save(plots.plot_distribution(ratios, ylabel=ylabel, bound=1.0), "sweep.png")
