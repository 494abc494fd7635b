// How far runs of a curve lie outside of boxes (see curvewise/subsequence.hpp): the curve and the
// boxes as the kernel of the level reads them.
#include <algorithm>
#include <stdexcept>

#include "curves/checks.hpp"
#include "curvewise/subsequence.hpp"
#include "runtime/aligned_buffer.hpp"
#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"

namespace curvewise {

RunsOutside runs_outside(const CurveView& low, const CurveView& high, const CurveView& Q,
                         Metric metric, bool of_largest) {
    const std::ptrdiff_t n = low.size(), m = Q.size(), dim = Q.dim();
    if (n < 1 || n != high.size() || low.dim() != dim || high.dim() != dim) {
        throw std::invalid_argument("low, high and Q have shapes " + curves::shape_of(low) + ", " +
                                    curves::shape_of(high) + " and " + curves::shape_of(Q) +
                                    "; give the corners of one box or more, in Q's dimensions");
    }
    if (dim == 1) metric = warping::canonical_metric({metric}, dim);
    const kernels::RunFunction find =
        warping::active_level().kernels->runs(metric, dim, of_largest);
    if (find == nullptr) {
        throw std::invalid_argument(
            "there are no bounds of this metric; give euclidean, sqeuclidean, cityblock or "
            "chebyshev");
    }
    const std::ptrdiff_t count = std::max<std::ptrdiff_t>(m - n + 1, 0);
    const std::ptrdiff_t stride = runtime::AlignedBuffer::rounded(m + kernels::runs_at_once);
    runtime::AlignedBuffer points(dim * stride), means(dim * stride), scales(dim * stride),
        totals(stride), boxes(2 * dim * n);
    std::fill_n(points.data(), dim * stride, 0.0);
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        for (std::ptrdiff_t i = 0; i < m; ++i) points.data()[c * stride + i] = Q(i, c);
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            boxes.data()[2 * dim * i + c] = low(i, c);
            boxes.data()[2 * dim * i + dim + c] = high(i, c);
        }
    }
    find({points.data(), stride, count, n, dim, boxes.data(), means.data(), scales.data(),
          totals.data()});
    RunsOutside found{{totals.data(), totals.data() + count}, {}};
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        const double* const of_runs = scales.data() + c * stride;
        found.scales.insert(found.scales.end(), of_runs, of_runs + count);
    }
    return found;
}

}  // namespace curvewise
