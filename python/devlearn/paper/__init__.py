"""Section VI of the paper: what is run, what is measured of it, its claims, figures and report."""
