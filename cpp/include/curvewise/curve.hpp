// A curve as every function of the library takes it: a view of n points with dim coordinates,
// owned by the caller, of any layout that two strides can describe. Costs nothing to copy.
#pragma once

#include <cstddef>
#include <string>

namespace curvewise {

class CurveView {
   public:
    // Row-major: point after point, its coordinates side by side.
    CurveView(const double* data, std::ptrdiff_t n, std::ptrdiff_t dim) noexcept
        : CurveView(data, n, dim, dim, 1) {}

    // Strides count doubles, not bytes, and may be negative. A column stride of 0 with dim = 1
    // says that the curve is a flat list of numbers: messages then print Q[17], not Q[17, 0].
    CurveView(const double* data, std::ptrdiff_t n, std::ptrdiff_t dim, std::ptrdiff_t row_stride,
              std::ptrdiff_t col_stride) noexcept
        : data_(data), n_(n), dim_(dim), row_stride_(row_stride), col_stride_(col_stride) {}

    double operator()(std::ptrdiff_t i, std::ptrdiff_t c) const noexcept {
        return data_[i * row_stride_ + c * col_stride_];
    }

    std::ptrdiff_t size() const noexcept { return n_; }
    std::ptrdiff_t dim() const noexcept { return dim_; }
    bool is_flat() const noexcept { return dim_ == 1 && col_stride_ == 0; }

    // "(5, 2)", or "(5,)" for a flat list.
    std::string shape() const;

   private:
    const double* data_;
    std::ptrdiff_t n_;
    std::ptrdiff_t dim_;
    std::ptrdiff_t row_stride_;
    std::ptrdiff_t col_stride_;
};

}  // namespace curvewise
