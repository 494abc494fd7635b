"""
Variants of dtw, and edit distances
===================================

The same two series, and what each variant matches in them. P has an outlier, and its peak comes
earlier than that of Q.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise

t = np.linspace(0, 1, 26)
P = np.exp(-(((t - 0.35) / 0.1) ** 2))
Q = np.exp(-(((t[:-2] - 0.5) / 0.12) ** 2))
P[20] = 0.8

alignments = {
    'dtw, "symmetric1"': curvewise.dtw_path(P, Q),
    "dtw, window=2": curvewise.dtw_path(P, Q, window=2),
    "dtw, penalty=0.2": curvewise.dtw_path(P, Q, penalty=0.2),
    'dtw, "symmetric2"': curvewise.dtw_path(P, Q, step_pattern="symmetric2"),
    'dtw, "symmetricP1"': curvewise.dtw_path(P, Q, step_pattern="symmetricP1"),
    'dtw, "asymmetric"': curvewise.dtw_path(P, Q, step_pattern="asymmetric"),
    "wdtw": curvewise.edit_path(P, Q, "wdtw"),
    "erp": curvewise.edit_path(P, Q, "erp"),
    "edr, epsilon=0.1": curvewise.edit_path(P, Q, "edr", epsilon=0.1),
    "lcss, epsilon=0.1": curvewise.edit_path(P, Q, "lcss", epsilon=0.1),
    "msm, cost=0.1": curvewise.edit_path(P, Q, "msm", cost=0.1),
    "twe": curvewise.edit_path(P, Q, "twe"),
}


def draw(ax, title, alignment):
    """Draw the matched points, and in red those that an edit distance changes or omits."""
    ax.plot(P + 1.2, ".-", label="P")
    ax.plot(Q, ".-", label="Q")
    steps = np.diff(alignment.path, axis=0, prepend=-1)
    for (i, j), (down, right) in zip(alignment.path, steps, strict=True):
        if title.startswith(("dtw", "wdtw")) or (down and right):
            is_changed = "epsilon" in title and abs(P[i] - Q[j]) > 0.1
            color = "tab:red" if is_changed else "0.6"
            ax.plot([i, j], [P[i] + 1.2, Q[j]], color=color, linewidth=0.6, zorder=0)
        else:
            ax.plot(i if down else j, P[i] + 1.2 if down else Q[j], "x", color="tab:red")
    ax.set_title(f"{title}: {alignment.distance:.2f}", fontsize="medium")
    ax.set(xticks=[], yticks=[])


figure, axes = plt.subplots(3, 4, figsize=(10.5, 6.5), layout="constrained")
for ax, (title, alignment) in zip(axes.flat, alignments.items(), strict=True):
    draw(ax, title, alignment)
axes[0, 0].legend(loc="upper left")

# %%
# dtw stretches; a window, a penalty, or steps of limited slope reduce the stretching. An edit
# distance may leave points out (red). edr and lcss count the points that are further apart than
# epsilon, so that an outlier counts once, however large it is. In the other measures it counts by
# its size:

for name in ("erp", "edr", "lcss", "msm", "twe", "wdtw"):
    options = {"epsilon": 0.1} if name in ("edr", "lcss") else {}
    values = []
    for outlier in (0.0, 0.8, 8.0):
        P[20] = outlier
        values.append(getattr(curvewise, name)(P, Q, **options))
    print(f"{name:>4}: " + ", ".join(f"{value:.2f}" for value in values))
