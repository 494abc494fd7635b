/// \file
/// The ground distance: how far apart two points are, for dtw and frechet, in any number of
/// coordinates, or on the sphere. A p below 1, or nan, or a radius that is not above 0 and finite,
/// makes the function that is given it throw std::invalid_argument.
///
///     curvewise::FrechetOptions options;
///     options.ground = {curvewise::Metric::minkowski, 3.0};
///
/// Or a function of one's own, which is asked for some rows of the table at a time:
///
///     const curvewise::BlockDistances own = [&](const curvewise::TableBlock& block, double* out) {
///         for (std::ptrdiff_t i = 0; i < block.rows; ++i)
///             for (std::ptrdiff_t j = 0; j < block.columns; ++j)
///                 *out++ = matrix[block.first_row + i][block.first_column + j];
///     };
///     options.ground.own = &own;
#pragma once

#include <cstddef>
#include <functional>

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

/// A part of the table of all pairs of points: those of P are its rows, those of Q its columns.
struct TableBlock {
    std::ptrdiff_t first_row;
    std::ptrdiff_t rows;
    std::ptrdiff_t first_column;
    std::ptrdiff_t columns;
};

/// Writes the distances of a block's pairs, each at least 0 or infinity, to `out`, row by row. It
/// is called by the thread that made the call, for blocks of at most 264 rows that are some 2^21
/// pairs or one row, more than once for the same pair where a path is asked for. What it throws
/// passes through.
using BlockDistances = std::function<void(const TableBlock& block, double* out)>;

/// A metric, with its order, or its radius; or a function of one's own.
struct GroundDistance {
    Metric metric = Metric::euclidean;
    /// The order of minkowski, 1 <= p <= inf; p = 1, 2 and inf are computed as cityblock,
    /// euclidean and chebyshev. Not used by the other metrics.
    double p = 2.0;
    /// Of the sphere of haversine, above 0; distances are in its unit. Not used by the others.
    double radius = earth_radius;
    /// In place of the metric where not null: for dtw, frechet, their paths, tables and infos, of a
    /// single pair, in one thread and without pruning; everything else throws
    /// std::invalid_argument. It must outlive the call.
    const BlockDistances* own = nullptr;

    /// The number that the metric asks for.
    constexpr double parameter() const noexcept { return metric == Metric::haversine ? radius : p; }

    /// The time that one distance in `dim` coordinates takes, roughly, in that of the fastest.
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
