// Walks around two closed curves. Rows are P's points and its first one again, columns are Q's
// points twice around and the first one again. A closed walk that begins at (0, k) ends at
// (n, k + m), which is the same pair.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "curvewise/ground_distance.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"
#include "warping/dispatch.hpp"
#include "warping/kernels/strip.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::warping {

// Sums. The first pair is met again at the end and counts once.
struct LeastSum {
    static double first(double /*cost*/) noexcept { return 0.0; }
    static double join(double before, double cost) noexcept { return before + cost; }
};

struct LeastMaximum {
    static double first(double cost) noexcept { return cost; }
    static double join(double before, double cost) noexcept { return std::max(before, cost); }
};

// The ground distances of one row, P's point against Q's, some columns at a time.
class RowDistances {
   public:
    RowDistances(const PackedCurve& P, const PackedCurve& Q, const GroundDistance& ground,
                 kernels::Cost cost)
        : P_(P), fill_(active_level().kernels->fill(cost)) {
        const auto room = static_cast<std::size_t>(Q.size() + kernels::padding);
        cost_.resize(room);
        point_.resize(room * static_cast<std::size_t>(Q.dim()));
        strip_.p = Q.data();
        strip_.p_stride = Q.stride();
        strip_.q = point_.data();
        strip_.q_stride = static_cast<std::ptrdiff_t>(room);
        strip_.columns = 1;
        strip_.dim = Q.dim();
        strip_.metric_parameter = ground.parameter();
        strip_.cost = cost_.data();
    }
    // Makes columns `first` to `last` of row i known.
    void compute(std::ptrdiff_t i, std::ptrdiff_t first, std::ptrdiff_t last) noexcept {
        for (std::ptrdiff_t c = 0; c < strip_.dim; ++c) {
            std::fill_n(point_.data() + c * strip_.q_stride + first,
                        last - first + kernels::padding, P_.data()[c * P_.stride() + i]);
        }
        fill_(strip_, 0, first, last);
    }
    double operator[](std::ptrdiff_t j) const noexcept {
        return cost_[static_cast<std::size_t>(j)];
    }

   private:
    const PackedCurve& P_;
    kernels::CostFunction fill_;
    runtime::ScratchVector<double> cost_, point_;
    kernels::Strip strip_{};
};

// The columns of a closed walk, by row.
struct Walk {
    runtime::ScratchVector<std::ptrdiff_t> first, last;
};

inline Walk walk_between(std::size_t rows, std::ptrdiff_t first, std::ptrdiff_t last) {
    return {runtime::ScratchVector<std::ptrdiff_t>(rows, first),
            runtime::ScratchVector<std::ptrdiff_t>(rows, last)};
}

// The walk from one start whose value is least, between two others.
template <class Rule>
class WalkSearch {
   public:
    WalkSearch(std::ptrdiff_t n, std::ptrdiff_t m, RowDistances& distances, Poller& poller)
        : n_(n),
          m_(m),
          distances_(distances),
          poller_(poller),
          row_(static_cast<std::size_t>(2 * m + 2), unreached),
          above_(row_),
          places_(static_cast<std::size_t>(n + 1)) {}

    // The value that walk() attains. The rows hold the columns between the first ones of `low` and
    // the last ones of `high`.
    double operator()(std::ptrdiff_t start, const Walk& low, const Walk& high) {
        codes_.clear();
        before_ = 0;
        behind_ = -1;
        for (std::ptrdiff_t i = 0; i <= n_; ++i) {
            const auto row = static_cast<std::size_t>(i);
            fill_row(i, start, std::max(low.first[row], start),
                     std::min(high.last[row], start + m_));
        }
        trace(start);
        return row_[static_cast<std::size_t>(start + m_)];
    }
    const Walk& walk() const noexcept { return walk_; }

   private:
    void fill_row(std::ptrdiff_t i, std::ptrdiff_t start, std::ptrdiff_t from, std::ptrdiff_t to) {
        std::swap(row_, above_);
        const auto count = static_cast<std::size_t>(to - from + 1);
        places_[static_cast<std::size_t>(i)] = {codes_.size(), from};
        codes_.resize(codes_.size() + count);
        distances_.compute(i, from, to);
        std::uint8_t* const codes = codes_.data() + codes_.size() - count - from;
        double* const row = row_.data();
        const double* const above = above_.data();
        double left = unreached;
        for (std::ptrdiff_t j = from; j <= to; ++j) {
            // The row above holds columns before_ to behind_.
            const double up = j <= behind_ ? above[j] : unreached;
            const double diagonal = j > before_ && j <= behind_ + 1 ? above[j - 1] : unreached;
            const bool is_up = up < diagonal;
            const double least = is_up ? up : diagonal;
            const bool is_left = left < least;
            codes[j] = is_left ? kernels::left : is_up ? kernels::up : kernels::diagonal;
            left = Rule::join(is_left ? left : least, distances_[j]);
            row[j] = left;
            if (i == 0 && j == start) row[j] = left = Rule::first(distances_[j]);
        }
        before_ = from;
        behind_ = to;
        if (poller_.count_steps(to - from + 1)) throw Stopped();
    }

    void trace(std::ptrdiff_t start) {
        walk_ = walk_between(places_.size(), 0, 0);
        std::size_t i = places_.size() - 1;
        std::ptrdiff_t j = start + m_;
        walk_.first[i] = walk_.last[i] = j;
        while (i > 0 || j > start) {
            const Place& place = places_[i];
            const auto code = codes_[place.begin + static_cast<std::size_t>(j - place.from)];
            if (code != kernels::up) --j;
            if (code != kernels::left) walk_.last[--i] = j;
            walk_.first[i] = j;
        }
    }

    static constexpr double unreached = std::numeric_limits<double>::infinity();

    struct Place {
        std::size_t begin;
        std::ptrdiff_t from;
    };

    std::ptrdiff_t n_, m_;
    RowDistances& distances_;
    Poller& poller_;
    runtime::ScratchVector<double> row_, above_;
    std::ptrdiff_t before_ = 0, behind_ = -1;
    runtime::ScratchVector<std::uint8_t> codes_;
    runtime::ScratchVector<Place> places_;
    Walk walk_;
};

}  // namespace curvewise::warping
