"""
Which letter was drawn?
=======================

Strokes of a pen, of different speed, size and slant. The nearest of the labelled strokes says which
letter a new one is.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise

random = np.random.default_rng(8)
corners = {
    "L": [(0, 2), (0, 0), (1.2, 0)],
    "V": [(0, 2), (0.7, 0), (1.4, 2)],
    "N": [(0, 0), (0, 2), (1.3, 0), (1.3, 2)],
    "Z": [(0, 2), (1.3, 2), (0, 0), (1.3, 0)],
}


def stroke(letter):
    """Draw a letter: corners shifted, speed uneven, the hand unsteady."""
    points = np.array(corners[letter]) + random.normal(0, 0.12, (len(corners[letter]), 2))
    at = np.sort(random.uniform(0, len(points) - 1, random.integers(40, 90)))
    line = np.column_stack([np.interp(at, np.arange(len(points)), x) for x in points.T])
    slant = np.array([[1, 0], [random.normal(0, 0.15), 1]])
    return line @ slant * random.uniform(0.6, 1.5) + random.normal(0, 0.015, line.shape)


def normal(line):
    """Put a stroke into a box of height 1, with its shape kept."""
    return (line - line.min(axis=0)) / np.ptp(line[:, 1])


letters = np.repeat(list(corners), 12)
known = [normal(stroke(letter)) for letter in letters]
asked = random.permutation(np.repeat(list(corners), 25))
new = [normal(stroke(letter)) for letter in asked]

# %%
# An index finds the three nearest without all distances, and they vote:

index = curvewise.Index(known, "dtw", normalize=True, step_pattern="symmetric2")
distances, places = index.kneighbors(new, n_neighbors=3)
votes = [np.unique(letters[row], return_counts=True) for row in places]
answers = np.array([names[np.argmax(counts)] for names, counts in votes])
print(f"{np.mean(answers == asked):.0%} of {len(asked)} strokes are read right")

# %%
# ``CurveKNeighborsClassifier`` of :mod:`curvewise.sklearn` does the same with scikit-learn's
# interface. Some strokes, and the predicted letters:

figure, axes = plt.subplots(2, 6, figsize=(9, 3.6), layout="constrained")
for ax, line, answer, truth in zip(axes.flat, new, answers, asked, strict=False):
    ax.plot(*line.T, ".-", color="#0072b2", linewidth=1.2, markersize=3)
    ax.set_title(f"{answer}", color="#009e73" if answer == truth else "#d55e00")
    ax.set(aspect="equal", xticks=[], yticks=[])
