#include "warping/narrow_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "runtime/scratch.hpp"
#include "warping/box_tree.hpp"
#include "warping/kernels/strip.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class NarrowTable {
   public:
    NarrowTable(const SweepProblem& problem, double most)
        : problem_(problem),
          n_(problem.curves.rows()),
          m_(problem.curves.columns()),
          lanes_(problem.kernels.lanes),
          bytes_(kernels::code_bytes(lanes_)),
          stride_(AlignedBuffer::rounded(m_ + 2 * kernels::padding)),
          memory_(3 * stride_) {
        strips_.reserve(static_cast<std::size_t>((n_ + lanes_ - 1) / lanes_));
        double* const columns = memory_.data();
        for (std::ptrdiff_t c = 0; c < 2; ++c) {
            double* const to = columns + c * stride_;
            const double* const q = problem.curves.q.data() + c * problem.curves.q.stride();
            std::fill_n(to, kernels::padding, 0.0);
            std::copy_n(q, m_ + kernels::padding, to + kernels::padding);
        }
        rows_.q = columns + kernels::padding + m_ - 1;
        rows_.p_stride = problem.curves.p.stride();
        rows_.q_stride = stride_;
        rows_.columns = m_;
        rows_.most = most;
        rows_.boundary = columns + 2 * stride_ + kernels::padding;
        rows_.first = 0;
        rows_.last = -1;
        rows_.corner = 0.0;
    }

    void sweep() {
        std::ptrdiff_t at = 0;  // the next code
        for (std::ptrdiff_t row = 0;; row += lanes_) {
            const auto end = static_cast<std::size_t>(at + (m_ - rows_.first + lanes_) * bytes_);
            if (codes_.size() < end) codes_.resize(std::max(end, codes_.size() * 3 / 2));
            strips_.push_back(at - rows_.first * bytes_);
            rows_.p = problem_.curves.p.data() + row;
            rows_.codes = codes_.data() + at;
            at += problem_.kernels.narrow(rows_) * bytes_;
            if (problem_.poller.count_steps(std::min(lanes_, n_ - row) * m_)) throw Stopped();
            if (row + lanes_ >= n_) break;  // the last lane may be behind the table
            rows_.corner = infinity;
            while (rows_.boundary[rows_.first] > rows_.most) ++rows_.first;
            while (rows_.boundary[rows_.last] > rows_.most) --rows_.last;
        }
    }

    IndexPairs path() const {
        IndexPairs path;
        path.reserve(static_cast<std::size_t>(std::max(n_, m_) * 9 / 8));
        std::ptrdiff_t i = n_ - 1, j = m_ - 1;
        path.push_back({i, j});
        for (std::size_t s = strips_.size(); s-- > 0;) {
            const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(s) * lanes_;
            const std::uint8_t* const codes = codes_.data() + strips_[s];
            while (i >= row && i + j > 0) {
                const std::ptrdiff_t lane = i - row;
                const unsigned code = unsigned{codes[(lane + j) * bytes_ + lane / 4]} >> lane % 4;
                const bool is_diagonal = i > 0 && j > 0 && (code >> 4U & 1U) != 0;
                const bool is_up = j == 0 || (i > 0 && (code & 1U) != 0);
                i -= static_cast<std::ptrdiff_t>(is_diagonal || is_up);
                j -= static_cast<std::ptrdiff_t>(is_diagonal || !is_up);
                path.push_back({i, j});
            }
        }
        std::reverse(path.begin(), path.end());
        return path;
    }

   private:
    const SweepProblem& problem_;
    std::ptrdiff_t n_, m_, lanes_;
    std::ptrdiff_t bytes_;  // of a diagonal's code
    std::ptrdiff_t stride_;
    AlignedBuffer memory_;  // the columns' points, and a row of the table
    kernels::NarrowRows rows_{};
    runtime::ScratchVector<std::ptrdiff_t> strips_;  // where the code of diagonal 0 would be
    runtime::ScratchVector<std::uint8_t> codes_;
};

// In the order of the table.
double cost_of(const SweepProblem& problem, const IndexPairs& path) noexcept {
    const PointAccess p(problem.curves.p, PointOrder::forward);
    const PointAccess q(problem.curves.q, PointOrder::reversed);
    double sum = 0.0;
    for (const auto& [i, j] : path) {
        sum += std::abs(p(i, 0) - q(j, 0)) + std::abs(p(i, 1) - q(j, 1));
    }
    return sum;
}

}  // namespace

bool has_narrow_path(const SweepProblem& problem) noexcept {
    return problem.rule == kernels::Rule::dtw_symmetric1 &&
           problem.cost.metric == Metric::cityblock && problem.curves.dim() == 2;
}

Path find_narrow_path(const SweepProblem& problem, double most) {
    NarrowTable table(problem, most);
    table.sweep();
    IndexPairs path = table.path();
    return {cost_of(problem, path), std::move(path)};
}

}  // namespace curvewise::warping
