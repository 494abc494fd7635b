/// \file
/// The ground distance: the distance of two points for dtw and frechet, in any number of
/// coordinates, or on the sphere. A function throws std::invalid_argument for a p below 1, or nan,
/// and for a radius that is not positive and finite.
///
///     curvewise::FrechetOptions options;
///     options.ground = {curvewise::Metric::minkowski, 3.0};
///
/// A custom function can replace the metric: curvewise/block_distances.hpp.
#pragma once

#include <cstddef>

#include "curvewise/options.hpp"

namespace curvewise {

/// How the differences of two points' coordinates become one number.
enum class Metric {
    euclidean,    ///< sqrt of the sum of squared differences (|difference| in one dimension)
    sqeuclidean,  ///< sum of squared differences
    cityblock,    ///< sum of absolute differences
    chebyshev,    ///< largest absolute difference
    minkowski,    ///< M (sum (|difference| / M)^p)^(1/p), M the largest |difference|
    haversine     ///< along the great circle, of points (longitude, latitude) in degrees
};

/// The names of the enumerators, in their order.
constexpr auto choice_names(Metric /*metric*/) noexcept {
    return names_up_to<Metric::haversine>("euclidean", "sqeuclidean", "cityblock", "chebyshev",
                                          "minkowski", "haversine");
}

/// The mean radius of the Earth in metres, (2 a + b) / 3 of its ellipsoid GRS 80 (Moritz, Geodetic
/// Reference System 1980, Journal of Geodesy 74, 2000).
inline constexpr double earth_radius = 6371008.8;

struct BlockDistances;

/// A metric, with its order, or its radius; or a custom function.
struct GroundDistance {
    Metric metric = Metric::euclidean;
    /// The order of minkowski, 1 <= p <= inf; p = 1, 2 and inf are computed as cityblock,
    /// euclidean and chebyshev. Not used by the other metrics.
    double p = 2.0;
    /// Radius of the sphere of haversine, above 0; distances are in its unit. Other metrics ignore
    /// it.
    double radius = earth_radius;
    /// If not null, replaces the metric for dtw, frechet, and their paths, tables and infos, of a
    /// single pair, in one thread and without pruning. All other functions throw
    /// std::invalid_argument. It must outlive the call.
    const BlockDistances* own = nullptr;

    /// The number that the metric asks for.
    constexpr double parameter() const noexcept { return metric == Metric::haversine ? radius : p; }

    /// The approximate time of one distance in `dim` coordinates, relative to the fastest.
    constexpr double weight(double dim) const noexcept {
        switch (metric) {
            case Metric::euclidean:
            case Metric::sqeuclidean:
            case Metric::cityblock:
            case Metric::chebyshev:
            case Metric::haversine:
                return dim;
            case Metric::minkowski:
                break;
        }
        return 16.0 * dim;
    }
};

}  // namespace curvewise
