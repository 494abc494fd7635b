/// \file
/// Eigen matrices as curves, without a copy: rows are points, columns coordinates. Takes any object
/// in memory that holds double: Matrix and Array of either storage order, Map with any strides,
/// Ref, Block, transpose. A vector is a flat list of numbers, one coordinate a point.
///
///     Eigen::MatrixX2d experiment = ...;
///     Eigen::MatrixX2d simulation = ...;
///     double value = curvewise::dtw(curvewise::curve_view(experiment),
///                                   curvewise::curve_view(simulation));
///
/// The caller must first evaluate an expression without its own memory, such as a sum or a cast,
/// since a view of a temporary matrix would outlive it: Eigen::MatrixXd Q = points.cast<double>().
/// Everything is inline. The compiled library receives only pointers and strides, not Eigen types.
/// So the caller may use any flags, alignment or version of Eigen.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <type_traits>

#include "curvewise/curve.hpp"

namespace curvewise {

/// Lives as long as the memory of `points` does. Throws nothing.
template <class Derived>
CurveView curve_view(const Eigen::DenseBase<Derived>& points) noexcept {
    static_assert(std::is_same_v<typename Derived::Scalar, double>,
                  "curvewise reads double: evaluate .cast<double>() into a matrix first");
    static_assert((Derived::Flags & Eigen::DirectAccessBit) != 0,
                  "an expression has no memory to view: evaluate it into a matrix first");
    const Derived& view = points.derived();
    if constexpr (Derived::ColsAtCompileTime == 1) {
        return {view.data(), view.rows(), 1, view.rowStride(), 0};  // flat: see curve.hpp
    } else {
        return {view.data(), view.rows(), view.cols(), view.rowStride(), view.colStride()};
    }
}

}  // namespace curvewise
