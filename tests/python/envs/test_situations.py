"""Which situation an observation of others is."""

import itertools
import pickle

import gymnasium
import numpy as np
import pytest
from conftest import refused
from devlearn.envs import DiscreteSituations, TileSituations
from gymnasium import spaces


def observations_of(space):
    """All observations that a space of whole numbers holds."""
    if isinstance(space, spaces.Discrete):
        return [space.start + i for i in range(space.n)]
    if isinstance(space, spaces.Tuple):
        return list(itertools.product(*map(observations_of, space)))
    bits = isinstance(space, spaces.MultiBinary)
    ranges = (
        [range(2)] * space.n
        if bits
        else [range(a, a + n) for a, n in zip(space.start.ravel(), space.nvec.ravel())]
    )
    return [np.array(each).reshape(space.shape) for each in itertools.product(*ranges)]


WHOLE = {
    "discrete": spaces.Discrete(7),
    "discrete from -2": spaces.Discrete(5, start=-2),
    "multi-discrete": spaces.MultiDiscrete([2, 3, 4]),
    "multi-discrete, an array": spaces.MultiDiscrete([[2, 3], [2, 2]], start=[[0, 1], [-1, 5]]),
    "multi-binary": spaces.MultiBinary(4),
    "a tuple": spaces.Tuple([spaces.Discrete(4), spaces.Discrete(3, start=1), spaces.Discrete(2)]),
}


@pytest.mark.parametrize("space", WHOLE.values(), ids=WHOLE)
def test_whole_numbers_are_digits_of_one_each_observation_has_its_own_id(space):
    situations = DiscreteSituations.of(space)
    ids = [situations(observation) for observation in observations_of(space)]
    # itertools.product counts as digits do, the last the fastest.
    assert ids == list(range(situations.count))


@pytest.mark.parametrize("space", WHOLE.values(), ids=WHOLE)
def test_what_a_space_draws_is_one_of_its_situations(space):
    space.seed(3)
    situations = DiscreteSituations.of(space)
    assert all(0 <= situations(space.sample()) < situations.count for _ in range(100))


@pytest.mark.parametrize("observation", [7, -1, 2.0, "3", (1, 2), None, [[1], [2, 3]]])
def test_an_observation_that_a_space_does_not_hold_is_refused(observation):
    refused(lambda: DiscreteSituations.of(spaces.Discrete(7))(observation), "observation")


OTHERS = [
    spaces.Box(0, 1, (2,)),
    spaces.Dict({"a": spaces.Discrete(2)}),
    spaces.Tuple([spaces.Discrete(2), spaces.Box(0, 1)]),
    spaces.Text(3),
]


@pytest.mark.parametrize("space", OTHERS)
def test_a_space_of_other_things_is_refused_and_the_way_out_is_said(space):
    error = refused(lambda: DiscreteSituations.of(space), "observation_space")
    assert "TileSituations" in error.allowed
    assert "function" in error.allowed


def test_more_situations_than_there_are_ids_are_refused():
    refused(lambda: DiscreteSituations.of(spaces.MultiBinary(64)), "situations")
    assert DiscreteSituations.of(spaces.MultiBinary(63)).count == 2**63
    refused(lambda: TileSituations([np.arange(2**16)] * 4), "situations")


@pytest.mark.parametrize(
    "counts, least", [((0,), (0,)), ((2, 2), (0,)), ((True,), (0,)), ("ab", (0, 0)), (3, (0,))]
)
def test_digits_that_are_none_are_refused(counts, least):
    refused(lambda: DiscreteSituations(counts, least))


# --- tiles ----------------------------------------------------------------------------------------


def test_a_tile_holds_its_lower_edge_and_the_outermost_have_no_end():
    situations = TileSituations([[-0.5, 0.5]])
    values = [-1e30, -0.6, -0.5, 0.0, np.nextafter(0.5, 0), 0.5, np.inf]
    assert [situations([value]) for value in values] == [0, 0, 1, 1, 1, 2, 2]


def test_tiles_are_digits_the_first_dimension_s_the_most_significant():
    situations = TileSituations([[0.0, 1.0], [], [10.0]])
    assert situations.count == 6
    centres = itertools.product([-1.0, 0.5, 2.0], [123.0], [0.0, 20.0])
    assert [situations(np.float32(centre)) for centre in centres] == list(range(6))


def test_even_tiles_are_equally_wide():
    space = spaces.Box(np.float32([-1, 0]), np.float32([1, 10]))
    situations = TileSituations.even(space, [4, 5])
    np.testing.assert_allclose(situations.edges[0], [-0.5, 0, 0.5])
    np.testing.assert_allclose(situations.edges[1], [2, 4, 6, 8])
    assert TileSituations.even(space, 1).count == 1
    refused(lambda: TileSituations.even(space, 10**9), "tiles")


@pytest.mark.parametrize("bound", [np.inf, np.finfo(np.float32).max])
def test_a_box_without_bounds_has_no_even_tiles_and_the_way_out_is_said(bound):
    space = spaces.Box(np.float32([-1, -bound]), np.float32([1, bound]))
    error = refused(lambda: TileSituations.even(space, 4), "observation_space")
    assert "in dimension 1" in error.value
    assert "from_quantiles" in error.allowed
    assert "edges" in error.allowed
    assert TileSituations.even(space, [4, 1]).count == 4  # which leaves that dimension out


EDGES = [3, "ab", [0.5], [[0.5, 0.5]], [[1.0, 0.0]], [[np.nan]], [[np.inf]], [["x"]], [[[1.0]]]]


@pytest.mark.parametrize("edges", EDGES, ids=map(str, EDGES))
def test_edges_that_are_none_are_refused(edges):
    error = refused(lambda: TileSituations(edges))
    assert error.quantity.startswith("TileSituations.edges")


@pytest.mark.parametrize("observation", [[0.0], [0.0] * 3, [np.nan, 0.0], [0, [1]], "ab"])
def test_an_observation_of_another_size_or_without_a_value_is_refused(observation):
    refused(lambda: TileSituations([[0.5], [0.5]])(observation), "observation")


class Wheel(gymnasium.Env):
    """Three numbers of known distribution, whatever is done: uniform, squared, and always 7."""

    observation_space = spaces.Box(-np.inf, np.inf, (3,))
    action_space = spaces.Discrete(3, start=1)

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        self.steps = 0
        return self.observation(), {"action_mask": np.int8([1, 0, 1])}

    def observation(self):
        u = self.np_random.random()
        return np.float64([u, u**2, 7.0])

    def step(self, action):
        assert action in (1, 3), "an action that is not allowed"
        self.steps += 1
        return self.observation(), 0.0, self.steps == 50, False, {"action_mask": [True, 0, 1]}


def test_quantiles_are_those_of_what_random_actions_of_those_allowed_meet():
    situations = TileSituations.from_quantiles(Wheel(), [4, 4, 4], warm_up=20_000, seed=5)
    quarters = np.array([0.25, 0.5, 0.75])
    np.testing.assert_allclose(situations.edges[0], quarters, atol=0.02)
    np.testing.assert_allclose(situations.edges[1], quarters**2, atol=0.02)
    assert situations.edges[2] == (7.0,)  # values that repeat


def test_the_same_seed_gives_the_same_quantiles_and_another_others():
    def edges(seed):
        return TileSituations.from_quantiles(Wheel(), 5, warm_up=500, seed=seed).edges

    assert edges(1) == edges(1) != edges(2)


def test_what_a_warm_up_cannot_mean_is_refused_before_it_begins():
    class Untouched(Wheel):
        def reset(self, **_):
            raise AssertionError("reset")

    def of(*arguments, **named):
        return lambda: TileSituations.from_quantiles(Untouched(), *arguments, **named)

    refused(of(0), "quantiles")
    refused(of([2, 2]), "quantiles")
    refused(of(2.5), "quantiles")
    refused(of(10**9, warm_up=10**9), "quantiles")
    refused(of(20, warm_up=10), "warm_up")
    refused(of(2, seed=-1), "seed")

    class Whole(Untouched):
        observation_space = spaces.Discrete(3)

    refused(lambda: TileSituations.from_quantiles(Whole(), 3), "observation_space")


def test_an_observation_that_is_not_finite_has_no_quantiles():
    class Broken(Wheel):
        def observation(self):
            return np.array([0.5, np.inf, 7.0])

    refused(lambda: TileSituations.from_quantiles(Broken(), 3, warm_up=10), "observation[1]")


@pytest.mark.parametrize(
    "situations",
    [DiscreteSituations.of(WHOLE["a tuple"]), TileSituations([[0.1, 0.2], []])],
)
def test_situations_are_compared_and_pickled_by_value(situations):
    again = pickle.loads(pickle.dumps(situations))
    assert again == situations
    assert hash(again) == hash(situations)
    assert len(pickle.dumps(situations)) < 300
