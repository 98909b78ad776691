import devlearn
from devlearn import plots

plots.save(plots.plot_sef_surface(devlearn.World.load("paper")), "sef_surface.png")
