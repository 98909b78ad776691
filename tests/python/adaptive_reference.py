"""The adaptive learner once more, in plain Python, from its definition, for tests to agree with.

Dicts and lists, no cleverness. Draws come from outside, so that it can be given the same ones.
"""

import contextlib
import heapq
import math

EXPLORE, EXPLOIT, EXHAUSTED, UNSTATED, HABIT, DEVIATION, HELD = range(7)
NOTHING, EXTENSION, REJECTION, ORIENTATION = range(4)

GOAL = None


class Situation:
    """What is held of one, by motion; its number says when it was met."""

    def __init__(self, number, motion_count, first_estimate, first_loss):
        self.number = number
        self.first_estimate = first_estimate  # h
        self.expected = first_loss  # E
        self.losses = [first_loss] * motion_count  # q
        self.outcomes = [{} for _ in range(motion_count)]  # next: [times, sum of losses]
        self.allowed = list(range(motion_count))  # at the last choice
        self.led_here = {}  # (situation, motion), in their order
        self.by_values = None  # the motion last chosen so
        self.interrupted = [None] * motion_count  # the round in which the last outcome was
        self.known = math.inf  # E where untried motions do not help
        self.hoped = first_loss  # E where stale ones do

    def effective(self):
        return [m for m, q in enumerate(self.losses) if self.outcomes[m] and q <= self.expected]

    def times(self, motion):
        return sum(times for times, _ in self.outcomes[motion].values())


class Waypoint:
    """The first decision in a situation on a round's way."""

    def __init__(self, motion, before, estimate):
        self.motion = motion
        self.before = before  # what the round had cost
        self.estimate = estimate
        self.interrupted = False  # it, or a later one there


class Decision:
    """A motion that is held."""

    def __init__(self, situation, motion, kind, before, estimate):
        self.situation = situation
        self.motion = motion
        self.kind = kind
        self.before = before
        self.estimate = estimate
        self.last_estimate = estimate
        self.spent = 0.0
        self.steps = 0


class Round:
    """The round under way."""

    def __init__(self):
        self.start = None
        self.cost = 0.0
        self.path = {}  # situation: Waypoint
        self.arrived = False
        self.by_habit = self.deviated = self.curious = False
        self.target = None  # (situation, motion)
        self.two_ways = False
        self.decisions_home = None  # since what is known was swept


class Sweep:
    """Passes over all situations, the one met last first, until one changes little."""

    def __init__(self, situations, visit, passes, small):
        self.situations = situations
        self.visit = visit
        self.passes = passes
        self.small = small
        self.begin_pass()

    def begin_pass(self):
        self.left = list(self.situations)
        self.change = 0.0
        self.found = False

    def go_on(self, visits):
        while self.left and visits > 0:
            visits -= 1
            change, found = self.visit(self.left.pop())
            self.change = max(self.change, change)
            self.found = self.found or found
            if not self.left:
                self.passes -= 1
                if self.passes > 0 and self.change >= self.small:
                    self.begin_pass()


class Adaptive:
    """The learner. `draw(count)` gives a whole number uniform on 0 ... count - 1."""

    def __init__(
        self,
        draw,
        motion_count=5,
        optimism=1.1,
        hold_limit=20,
        recollections=20,
        patience=10,
        gain=0.5,
        tolerance=0.0,
        detour=20.0,
        enough=3.0,
        refine=True,
        curious_every=0,
        stale_after=100,
        sweep_limit=0,
    ):
        self.draw = draw
        self.motion_count = motion_count
        self.optimism = optimism  # w
        self.hold_limit = hold_limit
        self.recollections = recollections
        self.patience = patience
        self.gain = gain
        self.tolerance = tolerance
        self.detour = detour
        self.enough = enough
        self.refine = refine
        self.curious_every = curious_every
        self.stale_after = stale_after
        self.sweep_limit = sweep_limit

        self.situations = {}  # by id, in the order they were met
        self.priorities = {}  # (situation, motion): priority
        self.queue = []  # (-priority, number, motion, situation): of these, and of the past
        self.explored_count = 0
        self.effective_count = 0

        self.rounds = 0
        self.round = None
        self.decision = None
        self.waiting = False
        self.least = math.inf  # cost of any round that arrived
        self.since = 0  # rounds without a better one
        self.since_look = 0  # rounds by habit
        self.looking = False
        self.habit_start = None
        self.habit_cost = math.inf
        self.habit = {}  # situation: Waypoint
        self.tried = {}  # (situation, motion): q at the beginning of the round after, or None
        self.home = self.falling = self.hope = None

    # Situations and their values

    def meet(self, situation, estimate):
        if situation not in self.situations:
            number, loss = len(self.situations), (self.optimism - 1.0) * estimate
            new = Situation(number, self.motion_count, estimate, loss)
            new.known = self.unknown_loss()
            self.situations[situation] = new
        return self.situations[situation]

    def first_loss(self, situation):
        return (self.optimism - 1.0) * self.situations[situation].first_estimate

    def mean_loss(self, situation, motion, loss_at):
        """Over the outcomes: the loss, and what is expected from there on."""
        total, count = 0.0, 0
        for following, (times, losses) in self.situations[situation].outcomes[motion].items():
            total += losses
            if following is not GOAL:
                total += times * loss_at(following)
            count += times
        return total / count

    def raise_priority(self, situation, motion, priority):
        if priority > self.priorities.get((situation, motion), 0.0):
            self.priorities[situation, motion] = priority
            number = self.situations[situation].number
            heapq.heappush(self.queue, (-priority, number, motion, situation))

    def take_first(self):
        """Of highest priority; of those met first, of the lowest motion."""
        while True:
            priority, _, motion, situation = heapq.heappop(self.queue)
            if self.priorities.get((situation, motion)) == -priority:
                del self.priorities[situation, motion]
                return situation, motion

    def settle(self, situation):
        """E is the least q of what is allowed; those that lead there hear of a change."""
        at = self.situations[situation]
        before, at.expected = at.expected, min(at.losses[m] for m in at.allowed)
        change = abs(at.expected - before)
        if change > 0.05:
            for mapping in at.led_here:
                self.raise_priority(*mapping, change)

    def recollect(self, times):
        while times > 0 and self.priorities:
            times -= 1
            situation, motion = self.take_first()
            with self.counted(situation):
                q = self.mean_loss(situation, motion, lambda s: self.situations[s].expected)
                self.situations[situation].losses[motion] = q
                self.settle(situation)

    @contextlib.contextmanager
    def counted(self, situation):
        """While a situation changes: NUM_RM and NUM_M."""
        at = self.situations[situation]
        explored, effective = sum(map(bool, at.outcomes)), len(at.effective())
        yield
        self.explored_count += sum(map(bool, at.outcomes)) - explored
        self.effective_count += len(at.effective()) - effective

    def add_outcome(self, situation, motion, following, loss, interrupted):
        at = self.situations[situation]
        first = not at.outcomes[motion]
        with self.counted(situation):
            outcome = at.outcomes[motion].setdefault(following, [0, 0.0])
            outcome[0] += 1
            outcome[1] += loss
            if following is not GOAL:
                self.situations[following].led_here[situation, motion] = True
            at.interrupted[motion] = self.rounds if interrupted and self.rounds > 0 else None
            self.settle(situation)
        self.raise_priority(situation, motion, math.inf)
        self.recollect(self.recollections)
        if not first:
            return ORIENTATION
        return EXTENSION if at.losses[motion] <= at.expected else REJECTION

    def forget_outcomes(self, situation, motion):
        at = self.situations[situation]
        if not at.outcomes[motion]:
            return
        for following in at.outcomes[motion]:
            if following is not GOAL:
                del self.situations[following].led_here[situation, motion]
        with self.counted(situation):
            at.outcomes[motion] = {}
            at.interrupted[motion] = None
            at.losses[motion] = self.first_loss(situation)
        self.priorities.pop((situation, motion), None)

    # Choosing

    def choose(self, situation, estimate, allowed=None):
        allowed = [m for m in range(self.motion_count) if allowed is None or allowed[m]]
        at = self.meet(situation, estimate)
        if self.round and self.round.arrived:
            self.round = None  # and no end of it: what follows belongs to none
        open_one = self.decision
        if open_one:
            same = open_one.situation == situation
            if same and open_one.motion in allowed:
                self.waiting = True
                return open_one.motion, HELD
            # It cannot be held, or the robot was put elsewhere.
            last = estimate if same else open_one.last_estimate
            self.close_decision(open_one.situation, last, True)
        if allowed != at.allowed:
            with self.counted(situation):
                at.allowed = allowed
                self.settle(situation)
        if self.round and not self.round.path and self.round.start != situation:
            self.start_round(situation, estimate)
        motion, kind = self.decide(situation, estimate)
        cost = self.round.cost if self.round else 0.0
        self.decision = Decision(situation, motion, kind, cost, estimate)
        self.waiting = True
        return motion, kind

    def decide(self, situation, estimate):
        at, now = self.situations[situation], self.round
        if now and now.by_habit and now.curious:
            if now.cost + at.hoped + estimate > self.habit_cost + 50.0:
                now.by_habit = False
            else:
                motion = min(at.allowed, key=lambda m: self.hope_of(situation, m))
                if self.is_stale(situation, motion):
                    return motion, DEVIATION
                return self.for_values(situation, motion)
        if now and now.by_habit and now.deviated and self.refine:
            if situation in now.path and now.path[situation].motion in at.allowed:
                return self.for_values(situation, now.path[situation].motion)
        elif now and now.by_habit:
            target = None if now.deviated else now.target
            if target and target[0] == situation and target[1] in at.allowed:
                return target[1], DEVIATION
            if situation in self.habit and self.habit[situation].motion in at.allowed:
                return self.habit[situation].motion, HABIT
        elif self.homeward():
            return self.for_values(situation, self.towards_home(situation))
        least = min(at.losses[m] for m in at.allowed)
        among = [m for m in at.allowed if at.losses[m] <= least + 1e-9]
        if at.by_values not in among:
            at.by_values = among[self.draw(len(among))]
        return self.for_values(situation, at.by_values)

    def for_values(self, situation, motion):
        return motion, EXPLOIT if self.situations[situation].outcomes[motion] else EXPLORE

    # Learning

    def learn(self, cost, following, next_estimate, interrupted=False):
        """Returns the event, and the cost to go from there on."""
        arrived = next_estimate == 0.0
        following = GOAL if arrived else following
        if not arrived:
            self.meet(following, next_estimate)
        made, event = self.decision, NOTHING
        if made.steps == 0:
            self.begin_decision()
        self.waiting = False
        made.spent += cost
        made.last_estimate = next_estimate
        made.steps += 1
        if self.round:
            self.round.cost += cost
            self.round.arrived = arrived
        if following != made.situation or interrupted or made.steps >= self.hold_limit:
            event = self.close_decision(following, next_estimate, interrupted)
        if self.round and self.round.by_habit:
            self.watch_habit(made, interrupted)
        for sweep in (self.home, self.falling, self.hope):
            if sweep:
                sweep.go_on(max(1, self.sweep_limit // self.motion_count))
        return event, self.value(following, next_estimate)

    def value(self, following, estimate):
        return estimate + (0.0 if following is GOAL else self.situations[following].expected)

    def begin_decision(self):
        """Its first step is made."""
        made, now = self.decision, self.round
        if not now:
            return
        if made.kind == DEVIATION:
            now.deviated = True
        if made.situation not in now.path:
            now.path[made.situation] = Waypoint(made.motion, made.before, made.estimate)
        elif now.path[made.situation].motion != made.motion:
            now.two_ways = True

    def close_decision(self, following, estimate, interrupted):
        made, now = self.decision, self.round
        looked = now and now.curious and self.is_stale(made.situation, made.motion)
        if looked and not interrupted:
            self.forget_outcomes(made.situation, made.motion)
        loss = made.spent + (estimate - made.estimate)
        event = self.add_outcome(made.situation, made.motion, following, loss, interrupted)
        if interrupted and now:
            now.path[made.situation].interrupted = True
        self.decision = None
        if looked:
            self.hope = self.swept(self.visit_hoping, 10, 0.5)
        return event

    def cancel(self):
        if self.decision.steps > 0:
            self.close_decision(self.decision.situation, self.decision.last_estimate, True)
        self.decision = None
        self.waiting = False

    def update(self, situation, motion, cost, following, next_estimate, estimate=None):
        at = self.meet(situation, estimate)
        following = GOAL if next_estimate == 0.0 else following
        if following is not GOAL:
            self.meet(following, next_estimate)
        loss = cost + (next_estimate - (at.first_estimate if estimate is None else estimate))
        event = self.add_outcome(situation, motion, following, loss, False)
        return event, self.value(following, next_estimate)

    def forget(self, situation):
        if situation not in self.situations:
            return False
        for motion in range(self.motion_count):
            self.forget_outcomes(situation, motion)
        with self.counted(situation):
            self.settle(situation)
        self.situations[situation].by_values = None
        if situation in self.habit:
            if self.round:
                self.round.by_habit = False
            self.drop_habit()
        return True

    def best(self, situation):
        at = self.situations[situation]
        tried = [m for m in range(self.motion_count) if at.outcomes[m]]
        return min(tried, key=lambda m: at.losses[m], default=None)

    # Rounds and the habit

    def begin_round(self):
        self.decision = None
        self.waiting = False
        self.round = Round()
        self.rounds += 1
        if self.curious_every > 0:
            for (situation, motion), then in list(self.tried.items()):
                now = self.situations[situation].losses[motion]
                if then is None:
                    self.tried[situation, motion] = now
                elif now < then - 2.0:
                    del self.tried[situation, motion]

    def end_round(self, arrived):
        ended, self.round = self.round, None
        self.decision = None
        self.waiting = False
        if ended and ended.path:
            self.count_round(ended, arrived)

    def count_round(self, ended, arrived):
        if arrived:
            self.least = min(self.least, ended.cost)
        if self.habit_start is not None and ended.start != self.habit_start:
            return
        if arrived and not ended.two_ways and ended.cost < self.habit_cost:
            self.habit_start = ended.start
            self.habit_cost = ended.cost
            self.habit = ended.path
            self.tried = {}
            self.since_look = 0
            self.looking = False
            if not ended.deviated:
                self.since = 0
        else:
            self.since += 1

    def start_round(self, situation, estimate):
        now = self.round
        now.start = situation
        now.curious = now.deviated = False
        now.target = None
        now.by_habit = (
            situation == self.habit_start
            and self.since >= self.patience
            and self.habit_cost < math.inf
        )
        if not now.by_habit:
            return
        if self.look_for_openings(situation, estimate):
            now.curious = now.deviated = True
            return
        now.target = self.look_for_target()
        falling = self.falling and self.falling.left
        if not now.target and self.refine and self.optimism > 1.0 and not falling:
            self.optimism = max(1.0, self.optimism - 0.05)
            self.tried = {}
            self.falling = self.swept(self.visit_falling, 1, 0.0)
            if self.sweep_limit == 0:
                self.recollect(20_000)
            if not self.falling.left:
                now.target = self.look_for_target()

    def look_for_target(self):
        """Of all other motions on the habit's way the one that promises most, if it does at all."""
        least, target = self.habit_cost - self.gain, None
        for situation, on_the_way in self.habit.items():
            at = self.situations[situation]
            for motion in at.allowed:
                if motion == on_the_way.motion or (situation, motion) in self.tried:
                    continue
                promise = on_the_way.before + on_the_way.estimate + at.losses[motion]
                if promise < least:
                    least, target = promise, (situation, motion)
        if target:
            self.tried[target] = None
        return target

    def watch_habit(self, made, interrupted):
        now = self.round
        if now.deviated:
            if now.cost > self.habit_cost + self.detour:
                now.by_habit = False
            return
        way = self.habit.get(made.situation)
        as_ever = not interrupted or (way and way.motion == made.motion and way.interrupted)
        if not as_ever or now.cost > self.habit_cost * (1.0 + self.tolerance):
            now.by_habit = False
            self.drop_habit()

    def drop_habit(self):
        self.habit_start = None
        self.habit_cost = math.inf
        self.habit = {}
        self.tried = {}
        self.since = 0
        self.since_look = 0
        self.looking = False

    # Sweeps over all that is known

    def swept(self, visit, passes, small):
        """A sweep that begins; without a limit, that was."""
        sweep = Sweep(self.situations, visit, passes, small)
        if self.sweep_limit == 0:
            sweep.go_on(math.inf)
        return sweep

    def visit_falling(self, situation):
        at = self.situations[situation]
        with self.counted(situation):
            for motion in range(self.motion_count):
                if not at.outcomes[motion]:
                    at.losses[motion] = self.first_loss(situation)
            self.settle(situation)
        return 0.0, False

    def unknown_loss(self):
        return 10.0 * self.least

    def homeward(self):
        now = self.round
        return now and not now.by_habit and now.cost > self.enough * self.least

    def loss_home(self, situation, motion):
        if not self.situations[situation].outcomes[motion]:
            return self.unknown_loss()

        def loss_at(following):
            known = self.situations[following].known
            return known if known < math.inf else self.unknown_loss()

        return self.mean_loss(situation, motion, loss_at)

    def visit_homeward(self, situation):
        at = self.situations[situation]
        before, at.known = at.known, min(self.loss_home(situation, m) for m in at.allowed)
        return abs(at.known - before), False

    def towards_home(self, situation):
        now = self.round
        if now.decisions_home is None or now.decisions_home >= 50:
            now.decisions_home = 0
            if not (self.home and self.home.left):
                self.home = self.swept(self.visit_homeward, 3, 0.5)
        now.decisions_home += 1
        allowed = self.situations[situation].allowed
        if self.draw(5) == 0:
            return allowed[self.draw(len(allowed))]
        return min(allowed, key=lambda m: self.loss_home(situation, m))

    def is_stale(self, situation, motion):
        then = self.situations[situation].interrupted[motion]
        return then is not None and self.rounds - then >= self.stale_after

    def hope_of(self, situation, motion):
        """q where what once was in the way is gone."""
        at = self.situations[situation]
        if not at.outcomes[motion]:
            return at.losses[motion]
        if self.is_stale(situation, motion):
            return min(at.losses[motion], self.first_loss(situation))
        return self.mean_loss(situation, motion, lambda s: self.situations[s].hoped)

    def visit_hoping(self, situation):
        at = self.situations[situation]
        before, at.hoped = at.hoped, min(self.hope_of(situation, m) for m in at.allowed)
        found = any(self.is_stale(situation, m) for m in range(self.motion_count))
        return abs(at.hoped - before), found

    def look_for_openings(self, situation, estimate):
        """Whether this round is to be curious."""
        if self.curious_every == 0:
            return False
        self.since_look += 1
        if self.since_look < self.curious_every:
            return False
        if not self.looking:
            self.looking = True
            for at in self.situations.values():
                at.hoped = at.expected
            self.hope = self.swept(self.visit_hoping, 60, 0.5)
        if self.hope.left:
            return False
        self.looking = False
        self.since_look = 0
        hoped = self.situations[situation].hoped + estimate
        return self.hope.found and hoped < self.habit_cost - 0.5
