"""
Clusters in a library of loops
==============================

Forty loops of four steels, of different lengths and with noise. The distances of all pairs show
which belong together.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.cluster.hierarchy import dendrogram, fcluster, linkage

import curvewise
from curvewise.datasets import kinematic_hardening

random = np.random.default_rng(0)


def loop(yield_stress, hardening):
    strain = 0.02 * np.sin(np.linspace(0, 2.5 * np.pi, random.integers(120, 200)))
    stress = kinematic_hardening(
        strain,
        yield_stress=yield_stress * random.normal(1, 0.02),
        backstresses=[(hardening * random.normal(1, 0.03), 300.0)],
    )
    return np.column_stack([strain / 0.02, (stress + random.normal(0, 4, len(strain))) / 500])


steels = [(220, 50e3), (300, 30e3), (300, 80e3), (420, 70e3)]
steel = random.permutation(np.repeat(np.arange(4), 10))
library = [loop(*steels[k]) for k in steel]

distances = curvewise.pdist(library, "dtw", normalize=True, step_pattern="symmetric2")
tree = linkage(distances, "average")
cluster = fcluster(tree, 4, "maxclust")

# %%
# Left: the tree of clusters. Right: the loops, in the colours of their clusters, and the medoid of
# each, the curve with the smallest sum of distances from the others.

colours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"]
figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.5), layout="constrained")
dendrogram(tree, ax=left, no_labels=True, color_threshold=0, above_threshold_color="0.4")
left.set(xlabel="40 loops", ylabel="dtw per step [-]")
for i, curve in enumerate(library):
    right.plot(*curve.T, color=colours[cluster[i] - 1], linewidth=0.5, alpha=0.6)
for k in range(1, 5):
    members = [library[i] for i in np.flatnonzero(cluster == k)]
    typical = members[curvewise.medoid(members)]
    right.plot(*typical.T, color=colours[k - 1], linewidth=2, label=f"cluster {k}: {len(members)}")
right.set(xlabel="strain / 0.02", ylabel="stress / 500 MPa")
right.legend(loc="upper left")

# %%
# Each cluster is one steel:

for k in range(1, 5):
    print(f"cluster {k}: steels {sorted({int(s) for s in steel[cluster == k]})}")
