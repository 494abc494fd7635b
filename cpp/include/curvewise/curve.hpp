/// \file
/// A curve, as every function of the library takes it: a view of n points with dim coordinates. The
/// caller owns the points, in any layout that two strides can describe. A view is cheap to copy and
/// never copies points. The points must live as long as the view.
///
///     CurveView(xy, 240, 2)               240 points, row-major: x0, y0, x1, y1, ...
///     CurveView(xy, 240, 2, 1, 240)       column-major: all x, then all y
///     CurveView(&rows[0].strain, n, 2, sizeof(Row) / sizeof(double), 1)
///                                         two neighbouring members of a struct of doubles
///     CurveView(points)                   a std::vector<std::array<double, 2>>, or of a struct of
///                                         two or three doubles; double points[240][2]
///     CurveView(values)                   a std::vector<double>, or double values[240], in one
///                                         dimension; in C++20 a std::span of all of these
///     curve_view(matrix)                  an Eigen matrix, map, block: curvewise/eigen.hpp
///     CurveView(floats, 240, 2, 2, 1)     of floats, for lists: cdist, pdist, Prepared, Index
///
/// A list of floats is never copied as a whole. Its curves are converted to doubles, exactly, for
/// each computation, some at a time. Functions of single pairs reject floats.
///
/// The compiler refuses a temporary vector or array, whose points would not outlive the call.
///
/// A view does not check anything. The function that receives it does, and throws
/// std::invalid_argument with the argument and the place: "Q[17, 1] is nan; curves must be finite".
/// Any number of threads may read a view while its points do not change.
#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#if __has_include(<version>)
#include <version>
#endif
#ifdef __cpp_lib_span
#include <span>
#endif

#include "curvewise/export.h"

namespace curvewise {

namespace points {  // what CurveView takes for the points of a list

// Whether T{double, ...} of `count` doubles is one, without narrowing: a member of another type
// of the same size is none.
template <class T, class Numbers, class = void>
inline constexpr bool is_made_of = false;
template <class T, class... Number>
inline constexpr bool
    is_made_of<T, std::tuple<Number...>, std::void_t<decltype(T{std::declval<Number>()...})>> =
        sizeof(T) == sizeof...(Number) * sizeof(double) &&
        std::is_standard_layout<T>::value&& std::is_trivially_copyable<T>::value;

// The coordinates of a point of this type, or 0 if it is none.
template <class T>
inline constexpr std::ptrdiff_t dim_of = is_made_of<T, std::tuple<double, double>>           ? 2
                                         : is_made_of<T, std::tuple<double, double, double>> ? 3
                                                                                             : 0;
template <>
inline constexpr std::ptrdiff_t dim_of<double> = 1;
template <std::size_t D>
inline constexpr std::ptrdiff_t dim_of<std::array<double, D>> =
    D > 0 && sizeof(std::array<double, D>) == D * sizeof(double) ? static_cast<std::ptrdiff_t>(D)
                                                                 : 0;
template <std::size_t D>
inline constexpr std::ptrdiff_t dim_of<double[D]> = static_cast<std::ptrdiff_t>(D);

template <class T>
inline constexpr bool is_point = dim_of<std::remove_cv_t<T>> > 0;

}  // namespace points

/// A view of n points with dim coordinates.
class CurveView {
   public:
    /// Row-major: point after point, its coordinates side by side.
    CurveView(const double* data, std::ptrdiff_t n, std::ptrdiff_t dim) noexcept
        : CurveView(data, n, dim, dim, 1) {}

    /// Strides count doubles, not bytes, and may be negative. A column stride of 0 with dim = 1
    /// marks a flat list of numbers: messages then print Q[17], not Q[17, 0].
    CurveView(const double* data, std::ptrdiff_t n, std::ptrdiff_t dim, std::ptrdiff_t row_stride,
              std::ptrdiff_t col_stride) noexcept
        : data_(data), n_(n), dim_(dim), row_stride_(row_stride), col_stride_(col_stride) {}

    /// A view of floats; strides count floats.
    CurveView(const float* data, std::ptrdiff_t n, std::ptrdiff_t dim, std::ptrdiff_t row_stride,
              std::ptrdiff_t col_stride) noexcept
        : floats_(data), n_(n), dim_(dim), row_stride_(row_stride), col_stride_(col_stride) {}

    /// A view without points, for `nullptr`, which would otherwise match both doubles and floats.
    CurveView(std::nullptr_t, std::ptrdiff_t n, std::ptrdiff_t dim, std::ptrdiff_t row_stride,
              std::ptrdiff_t col_stride) noexcept
        : CurveView(static_cast<const double*>(nullptr), n, dim, row_stride, col_stride) {}

    /// Not explicit, so that every function takes the vector itself. A point is a double, a
    /// std::array of doubles, or a trivially copyable type that is made of two or three doubles
    /// alone.
    template <class Point, class Allocator, std::enable_if_t<points::is_point<Point>, int> = 0>
    CurveView(const std::vector<Point, Allocator>& points) noexcept
        : CurveView(Sequence(), points.data(), points.size()) {}
    /// Not of a temporary, which would end before the view.
    template <class Point, class Allocator, std::enable_if_t<points::is_point<Point>, int> = 0>
    CurveView(const std::vector<Point, Allocator>&& points) = delete;

    /// Of an array, whose length is its number of points.
    template <class Point, std::size_t N, std::enable_if_t<points::is_point<Point>, int> = 0>
    CurveView(const Point (&points)[N]) noexcept : CurveView(Sequence(), points, N) {}
    template <class Point, std::size_t N, std::enable_if_t<points::is_point<Point>, int> = 0>
    CurveView(const Point (&&points)[N]) = delete;

#ifdef __cpp_lib_span
    template <class Point, std::size_t N, std::enable_if_t<points::is_point<Point>, int> = 0>
    CurveView(std::span<Point, N> points) noexcept
        : CurveView(Sequence(), points.data(), points.size()) {}
#endif

    /// Of doubles.
    double operator()(std::ptrdiff_t i, std::ptrdiff_t c) const noexcept {
        return data_[i * row_stride_ + c * col_stride_];
    }
    bool has_floats() const noexcept { return floats_ != nullptr; }
    /// Of floats.
    float float_at(std::ptrdiff_t i, std::ptrdiff_t c) const noexcept {
        return floats_[i * row_stride_ + c * col_stride_];
    }

    std::ptrdiff_t size() const noexcept { return n_; }
    std::ptrdiff_t dim() const noexcept { return dim_; }
    /// The coordinates of all points if they are contiguous doubles, row-major; otherwise null.
    const double* row_major() const noexcept {
        const bool is_row = col_stride_ == 1 || dim_ == 1;
        return is_row && row_stride_ == dim_ ? data_ : nullptr;
    }
    bool is_flat() const noexcept { return dim_ == 1 && col_stride_ == 0; }

   private:
    struct Sequence {};
    template <class Point>
    CurveView(Sequence /*tag*/, const Point* points, std::size_t size) noexcept
        : CurveView(reinterpret_cast<const double*>(points), static_cast<std::ptrdiff_t>(size),
                    points::dim_of<Point>, points::dim_of<Point>,
                    std::is_same_v<Point, double> ? 0 : 1) {}

    const double* data_ = nullptr;
    const float* floats_ = nullptr;
    std::ptrdiff_t n_;
    std::ptrdiff_t dim_;
    std::ptrdiff_t row_stride_;
    std::ptrdiff_t col_stride_;
};

}  // namespace curvewise
