// A curve whose coordinates are each moved a little towards 0, by pseudorandom amounts that are the
// same on every machine. Equal distances become different ones, and no coordinate leaves its range.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "curvewise/curve.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::curves {

class MovedCurve {
   public:
    // By at most 2^-30 of a distance, or by four units in the last place of the largest coordinate.
    MovedCurve(const CurveView& curve, double distance, std::minstd_rand& random)
        : points_(static_cast<std::size_t>(curve.size() * curve.dim())), dim_(curve.dim()) {
        std::size_t place = 0;
        double largest = 0.0;
        for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
            for (std::ptrdiff_t c = 0; c < dim_; ++c) {
                points_[place] = curve(i, c);
                largest = std::max(largest, std::abs(points_[place++]));
            }
        }
        const double most = std::max(distance * 0x1p-30, largest * 0x1p-50);
        constexpr auto range = static_cast<double>(std::minstd_rand::max());
        for (double& x : points_) {
            x -= std::copysign(most * (static_cast<double>(random()) / range), x);
        }
    }
    CurveView view() const noexcept {
        return {points_.data(), static_cast<std::ptrdiff_t>(points_.size()) / dim_, dim_};
    }

   private:
    runtime::ScratchVector<double> points_;
    std::ptrdiff_t dim_;
};

}  // namespace curvewise::curves
