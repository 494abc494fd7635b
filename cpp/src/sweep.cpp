#include "sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>

#include "allocation_error.hpp"
#include "dispatch.hpp"

namespace curvewise::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Long enough to amortise the ramps at both ends of a strip and the pass over the boundary row,
// short enough that three diagonals and the strip's points stay in the first-level cache.
constexpr std::ptrdiff_t max_strip_height = 256;

// A table is written down a diagonal: few rows at a time, so that their pages and lines stay near.
constexpr std::ptrdiff_t max_table_strip_height = 32;

std::ptrdiff_t strip_height(std::ptrdiff_t rows, kernels::Output output) noexcept {
    const std::ptrdiff_t most =
        output == kernels::Output::table ? max_table_strip_height : max_strip_height;
    const std::ptrdiff_t strips = (rows + most - 1) / most;
    return (rows + strips - 1) / strips;
}

// Owns what a kernels::Strip points to, and moves it from strip to strip down the table.
class StripWalk {
   public:
    StripWalk(const SweepProblem& problem, kernels::Output output, double* boundary)
        : problem_(problem),
          height_(strip_height(problem.curves.rows(), output)),
          lane_stride_(AlignedBuffer::rounded(height_ + 2 + kernels::padding)),
          lanes_(4 * lane_stride_),
          first_column_(static_cast<std::size_t>(height_)),
          last_column_(static_cast<std::size_t>(height_)),
          advance_(active_kernels().advance(problem.recurrence, problem.cost, problem.curves.dim(),
                                            output)),
          fill_(active_kernels().fill(problem.cost)) {
        const PackedPair& curves = problem.curves;
        strip_.p_stride = curves.p_stride();
        strip_.q = curves.q();
        strip_.q_stride = curves.q_stride();
        strip_.dim = curves.dim();
        strip_.columns = curves.columns();
        strip_.minkowski_p = problem.minkowski_p;
        strip_.first_column = first_column_.data();
        strip_.last_column = last_column_.data();
        strip_.boundary = boundary;
        strip_.codes = nullptr;
        strip_.table = nullptr;
        strip_.table_stride = curves.columns();
        strip_.code_stride = code_stride();
    }

    std::ptrdiff_t height() const noexcept { return height_; }
    std::ptrdiff_t code_stride() const noexcept { return height_; }

    // Prepares the strip whose first row is `row`, of the table's rows.
    void enter(std::ptrdiff_t row) noexcept {
        strip_.rows = std::min(height_, problem_.curves.rows() - row);
        strip_.p = problem_.curves.p() + row;
        for (std::ptrdiff_t k = 0; k < strip_.rows; ++k) {
            const ColumnRange range = problem_.band.columns(row + k);
            first_column_[static_cast<std::size_t>(k)] = range.first;
            last_column_[static_cast<std::size_t>(k)] = range.last;
        }
        std::fill_n(lanes_.data(), 3 * lane_stride_, infinity);
        strip_.before = lanes_.data();
        strip_.before_last = lanes_.data() + lane_stride_;
        strip_.current = lanes_.data() + 2 * lane_stride_;
        strip_.cost = lanes_.data() + 3 * lane_stride_;
        strip_.low_lane = 0;
        strip_.high_lane = -1;
        strip_.next_diagonal = first_diagonal();
        if (first_diagonal() > 0) strip_.before_last[0] = strip_.boundary[first_diagonal() - 1];
        is_first_ = row == 0;
    }

    std::ptrdiff_t first_diagonal() const noexcept { return first_column_[0]; }
    std::ptrdiff_t end_diagonal() const noexcept {
        return last_column_[static_cast<std::size_t>(strip_.rows - 1)] + strip_.rows;
    }
    void write_codes_to(std::uint8_t* codes) noexcept {
        strip_.codes = codes - first_diagonal() * code_stride();
    }
    void write_table_to(double* table) noexcept { strip_.table = table; }

    void sweep() noexcept {
        if (is_first_ && !problem_.open_begin) {
            // The 0 above cell (0, 0) starts every path; it is nobody's diagonal predecessor.
            advance_(strip_, strip_.next_diagonal + 1, fill_);
            strip_.before_last[0] = infinity;
        }
        advance_(strip_, end_diagonal(), fill_);
        // The row below may look one column further left than this strip's last row went.
        const std::ptrdiff_t first = first_column_[static_cast<std::size_t>(strip_.rows - 1)];
        if (first > 0) strip_.boundary[first - 1] = infinity;
    }

   private:
    const SweepProblem& problem_;
    std::ptrdiff_t height_;
    std::ptrdiff_t lane_stride_;
    AlignedBuffer lanes_;
    std::vector<std::ptrdiff_t> first_column_;
    std::vector<std::ptrdiff_t> last_column_;
    kernels::AdvanceFunction advance_;
    kernels::CostFunction fill_;
    kernels::Strip strip_{};
    bool is_first_ = false;
};

// The virtual row above the table: 0 where a path may begin.
BottomRow row_above(const SweepProblem& problem) {
    const std::ptrdiff_t columns = problem.curves.columns();
    BottomRow row(columns);
    std::fill_n(row.data(), columns, problem.open_begin ? 0.0 : infinity);
    row.data()[0] = 0.0;
    return row;
}

}  // namespace

void check_ground_distance(const GroundDistance& ground) {
    if (ground.metric == Metric::minkowski && !(ground.p >= 1.0)) {
        char p[32];
        std::snprintf(p, sizeof p, "%.17g", ground.p);
        throw std::invalid_argument("p is " + std::string(p) + "; minkowski needs 1 <= p <= inf");
    }
}

kernels::Cost canonical_cost(const GroundDistance& ground, std::ptrdiff_t dim) noexcept {
    if (ground.metric == Metric::sqeuclidean) return kernels::Cost::sqeuclidean;
    if (dim == 1) return kernels::Cost::cityblock;
    switch (ground.metric) {
        case Metric::cityblock:
            return kernels::Cost::cityblock;
        case Metric::chebyshev:
            return kernels::Cost::chebyshev;
        case Metric::minkowski:
            if (ground.p == 1.0) return kernels::Cost::cityblock;
            if (std::isinf(ground.p)) return kernels::Cost::chebyshev;
            if (ground.p != 2.0) return kernels::Cost::minkowski;
            break;
        default:
            break;
    }
    return kernels::Cost::euclidean;
}

BottomRow::BottomRow(std::ptrdiff_t columns)
    : columns_(columns), row_(columns + max_strip_height + kernels::padding) {}

std::ptrdiff_t BottomRow::argmin() const noexcept {
    return std::min_element(row_.data(), row_.data() + columns_) - row_.data();
}

BottomRow sweep(const SweepProblem& problem) {
    BottomRow bottom = row_above(problem);
    StripWalk walk(problem, kernels::Output::boundary_only, bottom.data());
    for (std::ptrdiff_t row = 0; row < problem.curves.rows(); row += walk.height()) {
        walk.enter(row);
        walk.sweep();
    }
    return bottom;
}

BottomRow sweep_into_table(const SweepProblem& problem, double* table) {
    const std::ptrdiff_t columns = problem.curves.columns();
    BottomRow bottom = row_above(problem);
    StripWalk walk(problem, kernels::Output::table, bottom.data());
    if (problem.band.is_limited()) {
        std::fill_n(table, problem.curves.rows() * columns, infinity);
    }
    for (std::ptrdiff_t row = 0; row < problem.curves.rows(); row += walk.height()) {
        walk.enter(row);
        walk.write_table_to(table + row * columns);
        walk.sweep();
    }
    return bottom;
}

PredecessorTable::PredecessorTable(const SweepProblem& problem)
    : rows_(problem.curves.rows()), open_begin_(problem.open_begin), bottom_(row_above(problem)) {
    StripWalk walk(problem, kernels::Output::codes, bottom_.data());
    strip_height_ = walk.height();
    std::ptrdiff_t size = 0;
    for (std::ptrdiff_t row = 0; row < rows_; row += strip_height_) {
        walk.enter(row);
        strips_.push_back({walk.first_diagonal(), size});
        size += (walk.end_diagonal() - walk.first_diagonal()) * walk.code_stride();
    }
    codes_ = allocate<std::uint8_t>(size, "the path's table of predecessors");
    for (std::size_t s = 0; s < strips_.size(); ++s) {
        walk.enter(static_cast<std::ptrdiff_t>(s) * strip_height_);
        walk.write_codes_to(codes_.get() + strips_[s].offset);
        walk.sweep();
    }
}

kernels::Predecessor PredecessorTable::at(std::ptrdiff_t i, std::ptrdiff_t j) const noexcept {
    const StripCodes& strip = strips_[static_cast<std::size_t>(i / strip_height_)];
    const std::ptrdiff_t lane = i % strip_height_;
    const std::ptrdiff_t diagonal = j + lane - strip.first_diagonal;
    return static_cast<kernels::Predecessor>(
        codes_[static_cast<std::size_t>(strip.offset + diagonal * strip_height_ + lane)]);
}

std::vector<std::array<std::int64_t, 2>> PredecessorTable::path_to(std::ptrdiff_t column) const {
    std::vector<std::array<std::int64_t, 2>> path;
    std::ptrdiff_t i = rows_ - 1;
    std::ptrdiff_t j = column;
    path.push_back({i, j});
    while (i > 0 || (j > 0 && !open_begin_)) {
        const kernels::Predecessor code = i == 0 ? kernels::left : j == 0 ? kernels::up : at(i, j);
        i -= code != kernels::left;
        j -= code != kernels::up;
        path.push_back({i, j});
    }
    std::reverse(path.begin(), path.end());
    return path;
}

}  // namespace curvewise::detail
