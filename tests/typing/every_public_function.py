"""A user's file that calls every public function; `mypy --strict` must accept it.

Each result is bound to the type that the documentation promises.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

import curvewise
import curvewise.compat as similaritymeasures
from curvewise import curves, datasets, plotting, read_curve, reference
from curvewise.commands import command_line as cli
from curvewise.commands import kernel_check

FloatArray = npt.NDArray[np.float64]

P, Q = datasets.hysteresis_pair(seed=1)
listed = [(0.0, 1.0), (1, 2)]

number: float = curvewise.area(P, Q, spacing="x", crossing="split", squared=True)
number = curvewise.area(listed, [[0, 1], [2, 3]])
found: curvewise.AreaQuads = curvewise.area_quads(P, Q, spacing="arc_length")
quads: FloatArray = found.quads
areas: FloatArray = curvewise.area_quads(P, Q, crossing="split")[1]
number = curvewise.pcm(P, Q, offsets="continuous")
number = curvewise.pcm(P, Q, offsets=np.int64(100))
match: curvewise.PcmMatch = curvewise.pcm_match(P, Q, offsets=50)
number = match.value + match.offset + match.coverage
mapped: str = match.mapped
points: FloatArray = match.points

number = curvewise.frechet(P, Q, metric="minkowski", p=3, workers=-1)
alignment: curvewise.Alignment = curvewise.frechet_path(P, Q, metric="chebyshev")
path: npt.NDArray[np.int64] = alignment.path
number = alignment.distance
table: FloatArray = curvewise.frechet_table(P, Q, metric="cityblock")
number = curvewise.dtw(P, Q, metric=lambda p, q: np.abs(p[:, :1] - q[:, 0]))
number = curvewise.frechet([0, 1], [0, 2], metric=[[0.0, 2.0], [1.0, 1.0]])
alignment = curvewise.dtw_path(P, Q, metric=np.zeros((len(P), len(Q))))
info: curvewise.WarpingInfo = curvewise.frechet_info(P, Q, prune=False)
info = curvewise.dtw_info(P, Q, step_pattern="symmetric2", window=3)
bounds: tuple[float, float] = info.bounds
number = curvewise.dtw(P, Q, metric="sqeuclidean", step_pattern="symmetric2", window=10)
pattern: curvewise.StepPattern = curvewise.StepPattern.named("typeIa")
number = curvewise.dtw(P, Q, step_pattern=pattern, penalty=1)
number = curvewise.erp(P, Q, gap=1) + curvewise.edr(P, Q) + curvewise.lcss(P, Q, epsilon=2)
number = curvewise.msm(P, Q, cost=1) + curvewise.twe(P, Q, stiffness=0) + curvewise.wdtw(P, Q)
number = curvewise.hausdorff(P, Q, metric="cityblock")
number = curvewise.area(P, Q, closed=True, crossing="polygon")
part: curvewise.CommonPart = curvewise.common_part(P, Q, 0.5, metric="haversine")
within: bool = bool(curvewise.tube(P, Q, 0.1, 0.2))
number = curvewise.hausdorff_continuous(P, Q, directed=True)
farthest: curvewise.FarthestPoints = curvewise.hausdorff_continuous_points(P, Q)
alignment = curvewise.edit_path(P, Q, "erp", gap=1)
table = curvewise.edit_table(P, Q, "lcss")
number = curvewise.dtw(P[:, 0], Q[:, 0], open_begin=True, open_end=True)
number = curvewise.dtw(P[:, 0], Q[:, 0], relax=(0, 1, 0, 2))
alignment = curvewise.dtw_path(P, Q, window=np.int32(3), workers=2)
table = curvewise.dtw_table(P, Q, metric="minkowski", p=np.inf)

number = curvewise.frechet_continuous(P, Q, workers=2)
bounds = curvewise.frechet_continuous(P, Q, bounds=True)
matching: curvewise.Matching = curvewise.frechet_continuous_path(P, Q)
matching = curvewise.frechet_continuous_part(P, Q)
parameters: FloatArray = matching.parameters
number = matching.distance
is_near: bool = curvewise.frechet_within(P, Q, np.float32(0.5), continuous=False)

number = curvewise.curve_length(P, Q, scale="mean_abs")
distances: FloatArray = curvewise.cdist([P, Q], [P], "pcm", offsets=50, workers=-1)
distances = curvewise.cdist([listed], measure=curvewise.mae, progress=print, cutoff=np.float32(3))
distances = curvewise.pdist(np.stack((P, P)), "frechet", metric="chebyshev", out=distances)
by_name = curvewise.cdist({"P": P, "Q": Q}, {"Q": Q})  # a DataFrame, whose types are pandas'
by_pair = curvewise.pdist({"P": P, "Q": Q}, "frechet").loc["P", "Q"]
distances = curvewise.pdist(np.stack((P, P)), layout="channels_last")
distances = curvewise.pdist(curve for curve in (P, Q))
slopes: FloatArray = curves.derivative(P)
layout: type[UserWarning] = curvewise.LayoutWarning
prepared = curvewise.Prepared(listed, "dtw", window=4)
number = prepared(Q) + prepared(Q, cutoff=2)
names: Sequence[str] = curvewise.available_measures()

index = curvewise.Index([P, Q], "dtw", window=3)
index.add([P])
index.remove([2])
index.save("index")
index = curvewise.Index.open(Path("index"))
places: npt.NDArray[np.int64] = index.indices
distances, places = index.kneighbors([P], 2, workers=2, progress=print)
places = index.kneighbors(n_neighbors=np.int64(1), return_distance=False)
near, far = index.radius_neighbors([P], 1.0, sort_results=False)
graph = index.kneighbors_graph([P], 1, mode="distance")
profile: curvewise.MatrixProfile = curvewise.matrix_profile(P, 5, window=1, exclusion=2, workers=2)
motifs: list[tuple[int, int]] = profile.motifs(k=2)
discords: list[int] = profile.discords(k=2)
runs: list[curvewise.Subsequence] = curvewise.subsequence(P[:5], Q, k=3, cutoff=9, path=True)
number = runs[0].distance + runs[0].start + runs[0].stop
mean: curvewise.DtwMean = curvewise.dtw_mean([P, Q], weights=[1, 2], iterations=2)
mean = curvewise.soft_dtw_mean([P, Q], gamma=0.1, initial=P, iterations=2)
average: FloatArray = mean.curve
chosen: int = curvewise.medoid([P, Q], "frechet", metric="chebyshev")

residuals: FloatArray = curvewise.curve_length_residuals(P, Q, scale="range")
number = curvewise.sum_of_squares(P, P) + curvewise.mse(P, P) + curvewise.mae(P, P)
value_and_slope: tuple[float, FloatArray] = curvewise.value_and_gradient(P, Q, "area", spacing="x")
number = curvewise.soft_dtw(P, Q, gamma=0.1, window=9) + curvewise.soft_dtw_divergence(P, Q)
number = curvewise.sbd(P, Q)
number = curvewise.lb_keogh(P, Q, window=0.1) + curvewise.lb_improved(P, Q, metric="cityblock")
number = curvewise.lb_kim(P, Q)
all_slopes: tuple[FloatArray, FloatArray, FloatArray] = curvewise.values_and_gradients(
    np.stack([P]), np.stack([Q]), "soft_dtw", workers=2, gamma=0.1
)
scaled: list[FloatArray] = curvewise.normalize(P, Q, listed)

comparison: curvewise.Comparison = curvewise.compare(P, Q, preset="paper", measures=["dtw"])
number = comparison["dtw"]
values: dict[str, float] = comparison.to_dict()
figure: Figure = comparison.plot()
compiler: str = curvewise.installation.build_info()["compiler"]
levels: list[str] = curvewise.installation.build_info()["instruction_sets"]
version: str = curvewise.__version__
include: str = curvewise.installation.get_include()

axes = figure.subplots()
plotting.plot_area(P, Q, axes, spacing="x")
plotting.plot_alignment(P, Q, axes, measure="frechet", metric="cityblock")
plotting.plot_pcm(P, Q, axes, offsets="continuous")
plotting.plot_curve_length(P, Q, axes)
plotting.plot_table(P, Q, axes, measure="dtw", window=3)
figure = plotting.plot_comparison(comparison)

number = reference.area(P, Q) + reference.pcm(P, Q) + reference.frechet(P, Q)
number = reference.dtw(P, Q, window=4) + reference.curve_length(P, Q, scale="range")
alignment = reference.dtw_path(P, Q)

number = float(similaritymeasures.area_between_two_curves(P, Q))
number = float(similaritymeasures.pcm(P, Q, norm_seg_length=True))
number = float(similaritymeasures.curve_length_measure(P, Q))
number = float(similaritymeasures.frechet_dist(P, Q, p=2))
distance, cumulative = similaritymeasures.dtw(P, Q, metric="canberra")
number = float(similaritymeasures.mae(P, P) + similaritymeasures.mse(P, P))

curve: FloatArray = read_curve(Path("loop.csv"), columns=["strain", "stress"])
curve = read_curve("loop.xlsx", sheet="data", factors=[0.01, 1])
turns: npt.NDArray[np.int64] = curves.turning_points(P, column=-2, reversal=0.2)
cycle: slice = curves.last_cycle(P, reversal=0.2)
curve = curves.resample(P, [40, 80, 80], turns=turns)
curve = curves.resample(listed, 5, by=[0.0, 1.0])
curve = curves.resample(P, 5, by=np.arange(241.0))
curve = curves.resample(P, spacing=0.5, metric="haversine")
curve = curves.simplify(P, 0.1, measure="hausdorff")
curve, rows = curves.simplify(P, 0.1, return_rows=True)
curve = curves.trim(P, 0, 0.01, by=0)
curve = curves.trim(P, 0, 1, by=[0.0, 1.0], metric="euclidean")
curve = curves.smooth(P, 9, order=3, turns=turns, columns=[1])
curve = curves.engineering_to_true(curves.shift_to_origin(P, elastic=(50, 250)))
all_equal: bool = kernel_check.run(sys.stdout)
status: int = cli.main(["info"])
