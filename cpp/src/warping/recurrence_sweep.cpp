#include "warping/recurrence_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "runtime/scratch.hpp"
#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"
#include "warping/window.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::ptrdiff_t max_height = 256;
constexpr std::ptrdiff_t margin = kernels::max_reach + kernels::padding;
constexpr std::ptrdiff_t cells_between_polls = 1 << 16;

// The rows of the table; with a point before the first of each curve, one more.
Band band_of(const Recurrence& recurrence, const PackedPair& curves) {
    const std::ptrdiff_t before = recurrence.border == Border::origin ? 1 : 0;
    const std::ptrdiff_t n = curves.rows() - before, m = curves.columns() - before;
    return {n, m, Window{recurrence.window, recurrence.window_fraction}.between(n, m)};
}

}  // namespace

double divisor(Per per, std::ptrdiff_t n, std::ptrdiff_t m) noexcept {
    switch (per) {
        case Per::one:
        case Per::matches:
            break;
        case Per::rows:
            return static_cast<double>(n);
        case Per::columns:
            return static_cast<double>(m);
        case Per::both:
            return static_cast<double>(n) + static_cast<double>(m);
        case Per::longer:
            return static_cast<double>(std::max(n, m));
    }
    return 1.0;
}

// The step that reached each cell of a part, strip by strip.
struct RecurrenceSweep::Codes {
    Codes(const Part& part, std::ptrdiff_t reach, std::ptrdiff_t height)
        : stride(std::min(height, part.end - part.first) + reach),
          per_strip((part.columns + stride + reach) * stride),
          content(static_cast<std::size_t>(per_strip * ((part.end - part.first) / height + 1))) {}

    std::ptrdiff_t stride;
    std::ptrdiff_t per_strip;
    runtime::ScratchVector<std::uint8_t> content;
};

RecurrenceSweep::RecurrenceSweep(const RecurrenceProblem& problem, std::ptrdiff_t coordinate,
                                 Poller& poller, RecurrenceMemory& memory)
    : recurrence_(problem.recurrence),
      table_(problem.steps),
      curves_(problem.curves),
      advance_(active_level().recurrences->advance(table_.steps.data(),
                                                   static_cast<std::ptrdiff_t>(table_.steps.size()),
                                                   table_.terms.data())),
      band_(band_of(recurrence_, curves_)),
      poller_(poller),
      memory_(memory),
      height_(max_height),
      reentry_(infinity) {
    if (recurrence_.ground.own != nullptr) {
        height_ = std::clamp<std::ptrdiff_t>(max_own_distances / curves_.columns(), 1, max_height);
    }
    kernels::Strip& ground = whole_.ground;
    const std::ptrdiff_t first = std::max<std::ptrdiff_t>(coordinate, 0);
    ground.p = curves_.p.data() + first * curves_.p.stride();
    ground.q = curves_.q.data() + first * curves_.q.stride();
    ground.p_stride = curves_.p.stride();
    ground.q_stride = curves_.q.stride();
    ground.dim = coordinate < 0 ? curves_.dim() : 1;
    ground.metric_parameter = recurrence_.ground.parameter();
    const kernels::Cost cost{canonical_metric(recurrence_.ground, ground.dim),
                             curves_.squares_are_in_domain(), recurrence_.ground.own != nullptr};
    fill_ = active_level().recurrences->fill(cost, ground.dim, std::min(curves_.rows(), height_));
    whole_.steps = table_.steps.data();
    whole_.step_count = static_cast<std::ptrdiff_t>(table_.steps.size());
    whole_.terms = table_.terms.data();
    whole_.rule = static_cast<kernels::PairRule>(recurrence_.pair);
    whole_.threshold = problem.threshold;
    whole_.reach = table_.reach;
    whole_.value_count = table_.value_diagonals;
    whole_.pair_count = table_.pair_diagonals;
    prepare_costs(problem.range);
}

// Every array has room for lanes before the first row and behind the last.
void RecurrenceSweep::prepare_costs(const RangeScale& range) {
    const std::ptrdiff_t n = curves_.rows(), m = curves_.columns();
    const bool has_gaps = recurrence_.gaps != Gaps::none;
    const bool has_moves = table_.uses(kernels::Source::row_move);
    const bool has_offsets =
        table_.uses(kernels::Source::offset) || recurrence_.pair == PairCost::weighted;
    const bool has_border =
        recurrence_.border == Border::zero || recurrence_.border == Border::all_gaps;
    if (!has_gaps && !has_moves && !has_offsets && !has_border) return;
    const std::ptrdiff_t longest = std::max(n, m) + 2 * margin;
    memory_.costs.reserve(8 * longest);
    double* next = memory_.costs.data();
    std::fill_n(next, 8 * longest, 0.0);
    const auto take = [&] { return std::exchange(next, next + longest) + margin; };
    if (has_gaps) {
        double* const rows = take();
        double* const columns = take();
        prepare_gaps(range.shrink(recurrence_.gap), rows, columns);
        whole_.row_gaps = rows;
        whole_.column_gaps = columns;
    }
    if (has_moves) {
        double* const rows = take();
        double* const columns = take();
        const double* const p = whole_.ground.p;
        const double* const q = whole_.ground.q;
        for (std::ptrdiff_t i = 1; i < n; ++i) rows[i] = p[i] - p[i - 1];
        for (std::ptrdiff_t r = 0; r + 1 < m; ++r) columns[r] = q[r] - q[r + 1];
        whole_.row_steps = rows;
        whole_.column_steps = columns;
    }
    for (int odd = 0; odd < 2 && has_offsets; ++odd) {
        double* const offsets = take() + m / 2;
        prepare_offsets(odd, offsets);
        whole_.offsets[odd] = offsets;
    }
    if (has_border) {
        left_border_ = take() - margin;
        reentry_ = recurrence_.border == Border::zero ? 0.0 : sum_of_row_gaps_;
        std::fill_n(left_border_, table_.reach - 1, infinity);
        std::fill_n(left_border_ + table_.reach, n, reentry_);  // behind the corner, which is 0
    }
}

// A deleted point costs its distance from a fixed point, or from the previous point. In reverse
// storage, the previous point is the one behind it.
void RecurrenceSweep::prepare_gaps(double gap, double* rows, double* columns) {
    const std::ptrdiff_t n = curves_.rows(), m = curves_.columns();
    kernels::Strip strip = whole_.ground;
    strip.columns = 1;
    const auto fill = [&](const double* points, std::ptrdiff_t stride, const double* others,
                          std::ptrdiff_t count, double* out) {
        strip.p = points;
        strip.p_stride = stride;
        strip.q = others;
        strip.cost = out;
        if (count > 0) fill_(strip, 0, 0, count - 1);
        std::fill_n(out + std::max<std::ptrdiff_t>(count, 0), kernels::padding, 0.0);
    };
    const double* const p = whole_.ground.p;
    const double* const q = whole_.ground.q;
    if (recurrence_.gaps == Gaps::to_point) {
        const bool is_on_sphere = takes_degrees(recurrence_.ground.metric);
        const std::ptrdiff_t lanes = std::max(n, m) + kernels::padding;
        runtime::ScratchVector<double> point(
            static_cast<std::size_t>(is_on_sphere ? strip.dim * lanes : lanes), gap);
        strip.q_stride = is_on_sphere ? lanes : 0;
        for (std::ptrdiff_t c = 0; is_on_sphere && c < strip.dim; ++c) {
            std::fill_n(point.data() + c * lanes, lanes, coordinate_on_sphere(gap, c));
        }
        fill(p, whole_.ground.p_stride, point.data(), n, rows);
        fill(q, whole_.ground.q_stride, point.data(), m, columns);
    } else {
        strip.q_stride = whole_.ground.p_stride;
        fill(p + 1, whole_.ground.p_stride, p, n - 1, rows + 1);
        strip.q_stride = whole_.ground.q_stride;
        fill(q, whole_.ground.q_stride, q + 1, m - 1, columns);
    }
    for (std::ptrdiff_t i = 0; i < n; ++i) sum_of_row_gaps_ += rows[i];
    for (std::ptrdiff_t r = m - 1; r >= 0; --r) sum_of_column_gaps_ += columns[r];
}

void RecurrenceSweep::prepare_offsets(int odd, double* offsets) const {
    const std::ptrdiff_t n = curves_.rows(), m = curves_.columns();
    const double half = static_cast<double>(std::max(n, m)) / 2.0;
    for (std::ptrdiff_t i = -(m / 2); i <= n / 2; ++i) {
        const double offset = std::abs(static_cast<double>(2 * i + odd));
        offsets[i] = recurrence_.pair != PairCost::weighted
                         ? offset
                         : 1.0 / (1.0 + std::exp(-recurrence_.steepness * (offset - half)));
    }
}

// Behind a point that is before both curves, the first row and column hold nothing else.
ColumnRange RecurrenceSweep::columns_of(std::ptrdiff_t row) const noexcept {
    if (recurrence_.border != Border::origin) return band_.columns(row);
    if (row == 0) return {0, 0};
    const ColumnRange columns = band_.columns(row - 1);
    return {columns.first + 1, columns.last + 1};
}

RecurrenceSweep::Rows RecurrenceSweep::first_boundary() const {
    const auto m = static_cast<std::size_t>(curves_.columns());
    Rows rows(static_cast<std::size_t>(table_.reach) * m, infinity);
    if (left_border_ != nullptr) {
        const bool is_zero = recurrence_.border == Border::zero;
        std::fill(rows.end() - static_cast<std::ptrdiff_t>(m), rows.end(),
                  is_zero ? 0.0 : sum_of_column_gaps_);
    }
    return rows;
}

RecurrenceSweep::End RecurrenceSweep::end(double give_up) {
    Rows boundary = first_boundary();
    const Part whole{0, curves_.rows(), curves_.columns()};
    Rows last_column;
    if (recurrence_.ends.p_end > 0) {
        last_column.resize(static_cast<std::size_t>(whole.end));
        ends_ = last_column.data();
    }
    sweep(whole, boundary.data(), whole.columns, nullptr, nullptr, give_up);
    ends_ = nullptr;
    return cheapest_end(boundary.data() + (table_.reach - 1) * whole.columns, last_column);
}

RecurrenceSweep::End RecurrenceSweep::cheapest_end(const double* last_row,
                                                   const Rows& last_column) const {
    const FreeEnds& ends = recurrence_.ends;
    const std::ptrdiff_t row = curves_.rows() - 1, column = curves_.columns() - 1;
    End found{last_row[column], row, column};
    if (ends.q_end == 0 && ends.p_end == 0) return found;
    double least = infinity;
    const auto compare = [&](double value, std::ptrdiff_t i, std::ptrdiff_t j) {
        const double divided = value / divisor(ends.per, i + 1, j + 1);
        if (!(divided < least)) return;
        least = divided;
        found = {value, i, j};
    };
    for (std::ptrdiff_t j = column - std::min(ends.q_end, column); j <= column; ++j) {
        compare(last_row[j], row, j);
    }
    for (std::ptrdiff_t i = row - std::min(ends.p_end, row); i < row; ++i) {
        compare(last_column[static_cast<std::size_t>(i)], i, column);
    }
    return found;
}

void RecurrenceSweep::write_table(double* out) {
    const std::ptrdiff_t n = curves_.rows(), m = curves_.columns();
    Rows boundary = first_boundary();
    if (band_.is_limited() || recurrence_.border == Border::origin) {
        poller_.in_runs(n, m, [&](auto first, auto end) {
            std::fill(out + first * m, out + end * m, infinity);
        });
    }
    sweep({0, n, m}, boundary.data(), m, nullptr, out, infinity);
}

// Sweeps a part strip by strip. The rows above it come in as `boundary`, the last ones leave so.
void RecurrenceSweep::sweep(const Part& part, double* boundary, std::ptrdiff_t stride, Codes* codes,
                            double* table, double give_up) {
    const std::ptrdiff_t reach = table_.reach;
    std::ptrdiff_t place = 0;
    for (std::ptrdiff_t first = part.first; first < part.end; first += height_, ++place) {
        kernels::RecurrenceStrip strip = whole_;
        aim(strip, part, first, std::min(height_, part.end - first));
        strip.boundary = boundary;
        strip.boundary_stride = stride;
        if (codes != nullptr) {
            strip.code_stride = codes->stride;
            strip.codes = codes->content.data() + place * codes->per_strip + reach * codes->stride;
        }
        if (table != nullptr) {
            strip.table_stride = part.columns;
            strip.table = table + (first - reach) * part.columns;
        }
        run(strip, part);
        if (give_up < infinity && is_hopeless(boundary, stride, give_up)) {
            for (std::ptrdiff_t r = 0; r < reach; ++r) {
                std::fill_n(boundary + r * stride, part.columns, infinity);
            }
            poller_.count_steps((part.end - std::min(part.end, first + height_)) * part.columns);
            return;
        }
    }
}

// Every path visits one of the rows that leave a strip, or comes in from the left behind it.
bool RecurrenceSweep::is_hopeless(const double* boundary, std::ptrdiff_t stride,
                                  double give_up) const noexcept {
    if (reentry_ <= give_up) return false;
    const auto count = static_cast<std::size_t>(table_.reach) * static_cast<std::size_t>(stride);
    return std::all_of(boundary, boundary + count, [=](double x) { return x > give_up; });
}

void RecurrenceSweep::aim(kernels::RecurrenceStrip& strip, const Part& part, std::ptrdiff_t first,
                          std::ptrdiff_t rows) {
    const std::ptrdiff_t reach = table_.reach, above = std::min(reach, first);
    strip.lanes = rows + reach;
    strip.columns = part.columns;
    // The curve is in reverse order, so the part starts this many points later.
    strip.ground.q += curves_.columns() - part.columns;
    strip.ground.columns = part.columns;
    strip.ground.p += first - above;
    strip.ground.rows = rows + above;
    if (recurrence_.ground.own != nullptr) ask_for_distances(strip.ground, first - above);
    if (left_border_ == nullptr) {
        const auto cells = [](std::ptrdiff_t left_out, std::ptrdiff_t count) {
            return std::min(left_out, count - 1) + 1;
        };
        const FreeEnds& ends = recurrence_.ends;
        if (first == 0) strip.start_columns = cells(ends.q_begin, part.columns);
        strip.start_rows = cells(ends.p_begin, curves_.rows()) - first;
    }
    if (ends_ != nullptr) strip.ends = ends_ + first - reach;
    strip.first_offset = first - reach;
    if (strip.row_gaps != nullptr) {
        strip.row_gaps += first - reach;
        strip.column_gaps += curves_.columns() - part.columns;
    }
    if (strip.row_steps != nullptr) {
        strip.row_steps += first - reach;
        strip.column_steps += curves_.columns() - part.columns;
    }
    if (left_border_ != nullptr) strip.left_border = left_border_ + first;

    memory_.columns.resize(static_cast<std::size_t>(2 * strip.lanes));
    std::ptrdiff_t* const columns = memory_.columns.data();
    for (std::ptrdiff_t k = reach; k < strip.lanes; ++k) {
        const ColumnRange range = columns_of(first + k - reach);
        columns[k] = range.first;
        columns[strip.lanes + k] = std::min(range.last, part.columns - 1);
    }
    strip.first_column = columns;
    strip.last_column = columns + strip.lanes;

    const std::ptrdiff_t length = AlignedBuffer::rounded(strip.lanes + kernels::padding) + 8;
    const std::ptrdiff_t count = strip.value_count + strip.pair_count + 3;
    memory_.lanes.reserve(count * length);
    double* next = memory_.lanes.data();
    std::fill_n(next, strip.value_count * length, infinity);
    std::fill_n(next + strip.value_count * length, (strip.pair_count + 3) * length, 0.0);
    const auto take = [&] { return std::exchange(next, next + length); };
    for (std::ptrdiff_t i = 0; i < strip.value_count; ++i) strip.values[i] = take();
    for (std::ptrdiff_t i = 0; i < strip.pair_count; ++i) strip.pairs[i] = take();
    strip.code_lanes = take();
    if (strip.row_steps != nullptr) {
        strip.row_moves = take();
        strip.column_moves = take();
    }
    strip.next_diagonal = -reach;
    strip.low_lane = reach;
    strip.high_lane = reach - 1;
}

// Requests the distances of whole rows, since steps also visit cells outside of the window.
void RecurrenceSweep::ask_for_distances(kernels::Strip& ground, std::ptrdiff_t first) {
    memory_.own_distances.reserve(ground.rows * ground.columns);
    double* const distances = memory_.own_distances.data();
    (*recurrence_.ground.own)({first, ground.rows, 0, ground.columns}, distances);
    ground.own = distances;
    ground.own_stride = ground.columns;
}

void RecurrenceSweep::run(kernels::RecurrenceStrip& strip, const Part& part) {
    const std::ptrdiff_t rows = strip.lanes - table_.reach;
    const std::ptrdiff_t end = part.columns + strip.lanes;
    const std::ptrdiff_t chunk = cells_between_polls / strip.lanes;
    const auto weight = static_cast<std::int64_t>(table_.terms.size() / 3 + 1);
    while (strip.next_diagonal < end) {
        const std::ptrdiff_t from = strip.next_diagonal;
        advance_(strip, std::min(end, from + chunk), fill_);
        const auto counted = [&](std::ptrdiff_t t) {
            return std::clamp<std::ptrdiff_t>(t, 0, part.columns);
        };
        const std::int64_t steps = rows * (counted(strip.next_diagonal) - counted(from));
        if (!is_counting_) {
            poller_.spend(steps * weight);
        } else if (poller_.count_steps(steps, weight)) {
            throw Stopped();
        }
    }
}

IndexPairs RecurrenceSweep::path(const End& end) {
    found_.clear();
    is_counting_ = false;
    find(0, first_boundary(), {end.row, end.column});
    std::reverse(found_.begin(), found_.end());
    return std::move(found_);
}

// Adds the path that ends at `end`, backwards, up to where it leaves the rows from `first` on, and
// returns the cell above them that it comes from.
RecurrenceSweep::Cell RecurrenceSweep::find(std::ptrdiff_t first, const Rows& boundary, Cell end) {
    const std::ptrdiff_t rows = end.row - first + 1, columns = end.column + 1;
    const std::ptrdiff_t most =
        (std::ptrdiff_t{1} << 22) + 16 * (curves_.rows() + curves_.columns());
    if (rows <= 2 * table_.reach || rows * columns <= most) return trace(first, boundary, end);
    const std::ptrdiff_t middle = first + rows / 2;
    Rows below = boundary;
    sweep({first, middle, columns}, below.data(), curves_.columns(), nullptr, nullptr, infinity);
    const Cell left = find(middle, below, end);
    if (left.row < first || left.column < 0) return left;
    Rows().swap(below);
    return find(first, boundary, left);
}

RecurrenceSweep::Cell RecurrenceSweep::trace(std::ptrdiff_t first, const Rows& boundary, Cell end) {
    const Part part{first, end.row + 1, end.column + 1};
    const std::ptrdiff_t reach = table_.reach;
    Codes codes(part, reach, height_);
    Rows rows = boundary;
    sweep(part, rows.data(), curves_.columns(), &codes, nullptr, infinity);
    const auto code = [&](const Cell& at) {
        const std::ptrdiff_t strip = (at.row - first) / height_;
        const std::ptrdiff_t lane = (at.row - first) % height_ + reach;
        return codes.content[static_cast<std::size_t>(
            strip * codes.per_strip + (reach + at.column + lane) * codes.stride + lane)];
    };
    Cell at = end;
    while (at.row >= first && at.column >= 0) {
        found_.push_back({at.row, at.column});
        const std::uint8_t taken = code(at);
        if (taken == kernels::start_code || (at.row == 0 && at.column == 0)) return {-1, -1};
        const Step& step = recurrence_.steps[taken];
        for (auto term = step.terms.rbegin(); term != step.terms.rend(); ++term) {
            if (term->from != CostFrom::pair || term->rows + term->columns == 0) continue;
            if (term->rows == step.rows && term->columns == step.columns) continue;
            found_.push_back({at.row - term->rows, at.column - term->columns});
        }
        at = {at.row - step.rows, at.column - step.columns};
    }
    return at;
}

}  // namespace curvewise::warping
