"""The colours of all pictures: those of Okabe and Ito (2008), told apart by the colour-blind."""

from __future__ import annotations

from ._core import Kind

BLACK = "#000000"
ORANGE = "#E69F00"
GREEN = "#009E73"
BLUE = "#0072B2"
VERMILLION = "#D55E00"
PURPLE = "#CC79A7"
SKY = "#56B4E9"
GREY = "#7F7F7F"
INK = "#222222"
OBSTACLE = "#A9CBE6"  # the paper's blue, light enough to draw over

BY_KIND = {
    Kind.UNSTATED: GREY,
    Kind.HELD: SKY,
    Kind.HABIT: BLUE,
    Kind.DEVIATION: VERMILLION,
    Kind.EXPLORE: ORANGE,
    Kind.EXHAUSTED: BLUE,
    Kind.EXPLOIT: BLACK,
}
"""Steps by why their motion was chosen, in the order in which they are drawn."""
