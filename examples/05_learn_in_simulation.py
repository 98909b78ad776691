"""Learning in simulation, for a robot that has yet to be built.

The whole loop of the paper, in devlearn's simulator; at the end what was learned goes into a file.
06_go_on_elsewhere takes it from there, in C++ or Python, whichever wrote it.

    05_learn_in_simulation FILE
"""

import sys

import devlearn

if len(sys.argv) != 2:
    sys.exit("usage: 05_learn_in_simulation FILE")
world = devlearn.World(width=3.0, height=3.0, start=(0.5, 0.5, 0.0), target=(2.4, 2.4))


def steps_of_rounds(trial, rounds):
    return [int(steps) for steps in trial.path_learning(rounds, step_limit=5000).rounds["steps"]]


def median(values):
    return sorted(values)[len(values) // 2]


learned = 0
for seed in range(1, 6):
    trial = devlearn.Trial(world, devlearn.TrialConfig.paper(), seed)
    first = steps_of_rounds(trial, 1)[0]
    trial.free_learning(5000)
    rounds = steps_of_rounds(trial, 60)
    late = median(rounds[40:])
    print(f"seed {seed}: first round {first} steps, rounds 41 to 60 a median of {late} steps")
    learned += late < first
    if seed == 1:
        trial.learner.save(sys.argv[1])
        situations, motions = trial.learner.situations_experienced, trial.learner.effective_count
        print(f"  saved: {situations} situations, {motions} motions")
sys.exit(not learned >= 4)
