#include "warping/strip_walk.hpp"

#include <algorithm>
#include <limits>

#include "warping/ground_distance.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A table is written down a diagonal: few rows at a time, so that their pages and lines stay near.
constexpr std::ptrdiff_t max_table_height = 32;

// Threads need strips to share, each of them tall enough to be worth its ramps.
constexpr std::ptrdiff_t strips_per_worker = 4;
constexpr std::ptrdiff_t min_shared_height = 64;

kernels::Output output_of(const Destination& destination, const LiveColumns& columns) noexcept {
    if (destination.table != nullptr) return kernels::Output::table;
    if (destination.codes != nullptr) {
        return columns.cost_to_go() != nullptr ? kernels::Output::narrow_codes
                                               : kernels::Output::codes;
    }
    if (destination.origins != nullptr) return kernels::Output::origins;
    return kernels::Output::boundary_only;
}

kernels::AdvanceFunction resident_advance(const SweepProblem& problem, const Region& region,
                                          kernels::Output output) noexcept {
    const std::ptrdiff_t shorter_side = problem.is_always_resident
                                            ? std::numeric_limits<std::ptrdiff_t>::max()
                                            : std::min(region.rows, region.columns);
    if (output != kernels::Output::boundary_only || problem.columns.is_limited() ||
        problem.columns.cost_to_go() != nullptr || shorter_side < kernels::resident_rows) {
        return nullptr;
    }
    return problem.kernels.resident(problem.rule, problem.cost, problem.curves.dim(), shorter_side);
}

std::ptrdiff_t strip_height(const SweepProblem& problem, const Region& region,
                            std::ptrdiff_t workers, kernels::Output output) noexcept {
    const std::ptrdiff_t rows = region.rows;
    std::ptrdiff_t most = max_strip_height;
    if (problem.own != nullptr) {
        most = std::clamp<std::ptrdiff_t>(max_own_distances / region.columns, 1, most);
    }
    if (output == kernels::Output::table) most = std::min(most, max_table_height);
    if (workers > 1) {
        most = std::min(most, std::max(min_shared_height, rows / (strips_per_worker * workers)));
    }
    const std::ptrdiff_t strips = (rows + most - 1) / most;
    return (rows + strips - 1) / strips;
}

// Doubles before and behind the lane arrays, a page, if several threads sweep. Prefetchers run past
// the end of one thread's data and would take the lines that another is writing (measured: a third
// of the speed).
constexpr std::ptrdiff_t gap_between_threads = 512;

// The lane arrays: values and origins of three diagonals, and the costs of one.
enum Lanes : std::ptrdiff_t { values = 0, costs = 3, origins = 4, count = 7 };

}  // namespace

std::ptrdiff_t worker_count(const SweepProblem& problem, const Region& region) noexcept {
    const std::ptrdiff_t useful = region.rows * region.columns / problem.cells_per_worker;
    return std::max<std::ptrdiff_t>(1, std::min(problem.workers, useful));
}

StripPlan::StripPlan(const SweepProblem& problem, const Region& region, std::ptrdiff_t workers,
                     const Destination& destination) noexcept
    : problem_(&problem),
      region_(region),
      destination_(destination),
      output_(output_of(destination, problem.columns)),
      resident_(resident_advance(problem, region, output_)),
      height_(resident_ != nullptr ? kernels::resident_rows
                                   : strip_height(problem, region, workers, output_)),
      workers_(std::min(workers, (region.rows + height_ - 1) / height_)) {}

ColumnRange StripPlan::columns(std::ptrdiff_t row) const noexcept {
    const ColumnRange range = problem_->columns.columns(region_.first_row + row);
    return {std::max<std::ptrdiff_t>(range.first - region_.first_column, 0),
            std::min(range.last - region_.first_column, region_.columns - 1)};
}

StripWalk::StripWalk(const StripPlan& plan, bool starts_here, double* boundary, SweepMemory& memory,
                     StripEdge* edges)
    : plan_(&plan),
      memory_(&memory),
      starts_here_(starts_here),
      lane_stride_(AlignedBuffer::rounded(plan.height_ + 2 + kernels::padding)),
      advance_(plan.resident_ != nullptr
                   ? plan.resident_
                   : plan.problem_->kernels.advance(plan.problem_->rule, plan.problem_->cost,
                                                    plan.problem_->curves.dim(), plan.output_)),
      fill_(plan.problem_->kernels.fill(plan.problem_->cost)) {
    const std::ptrdiff_t gap = plan.workers_ > 1 ? gap_between_threads : 0;
    const bool has_origins = plan.output_ == kernels::Output::origins;
    memory.lanes.reserve(2 * gap + lane_stride_ * (has_origins ? count : origins));
    lanes_ = memory.lanes.data() + gap;
    columns_ = memory.columns(static_cast<std::size_t>(2 * plan.height_));
    const PackedPair& curves = plan.problem_->curves;
    const Region& region = plan.region_;
    strip_.p_stride = curves.p.stride();
    strip_.q = curves.q.data() + curves.columns() - region.first_column - region.columns;
    strip_.q_stride = curves.q.stride();
    strip_.dim = curves.dim();
    strip_.columns = region.columns;
    strip_.metric_parameter = plan.problem_->metric_parameter;
    strip_.first_column = columns_;
    strip_.last_column = columns_ + plan.height_;
    strip_.boundary = boundary;
    strip_.origin_boundary = plan.destination_.origins;
    strip_.code_stride = plan.height_;
    strip_.table_stride = region.columns;
    const LiveColumns& live = plan.problem_->columns;
    if (live.cost_to_go() != nullptr) {
        narrower_ = StripNarrower(*live.cost_to_go(), *live.swept(), edges);
    }
}

void StripWalk::ask_for_distances(std::ptrdiff_t strip) {
    const Region& region = plan_->region_;
    const SweepProblem& problem = *plan_->problem_;
    const std::ptrdiff_t row = strip * plan_->height_;
    const std::ptrdiff_t rows = std::min(plan_->height_, region.rows - row);
    ColumnRange asked{0, region.columns - 1};
    if (problem.columns.is_limited()) {
        asked = {plan_->columns(row).first, plan_->columns(row + rows - 1).last};
    }
    const std::ptrdiff_t columns = asked.last - asked.first + 1;
    memory_->own_distances.reserve(rows * columns);
    double* const distances = memory_->own_distances.data();
    (*problem.own)({region.first_row + row, rows, region.first_column + asked.first, columns},
                   distances);
    strip_.own = distances - asked.first;
    strip_.own_stride = columns;
}

void StripWalk::enter(std::ptrdiff_t strip) noexcept {
    const std::ptrdiff_t row = strip * plan_->height_;
    strip_.rows = std::min(plan_->height_, plan_->region_.rows - row);
    strip_.p = plan_->problem_->curves.p.data() + plan_->region_.first_row + row;
    if (!plan_->problem_->columns.is_limited()) {
        std::fill_n(columns_, strip_.rows, 0);
        std::fill_n(columns_ + plan_->height_, strip_.rows, strip_.columns - 1);
    } else {
        std::ptrdiff_t* const first = columns_;
        std::ptrdiff_t* const last = columns_ + plan_->height_;
        for (std::ptrdiff_t k = 0, rows = strip_.rows; k < rows; ++k) {
            const ColumnRange range = plan_->columns(row + k);
            first[k] = range.first;
            last[k] = range.last;
        }
    }
    const bool is_dead = narrower_.is_on() && !narrower_.enter(strip_, strip, row, columns_);
    strip_.low_lane = 0;
    strip_.high_lane = -1;
    strip_.next_diagonal = strip_.first_column[0];
    first_diagonal_ = strip_.next_diagonal;
    end_diagonal_ = is_dead ? first_diagonal_ : strip_.last_column[strip_.rows - 1] + strip_.rows;
    counted_ = 0;
    at_start_ = starts_here_ && strip == 0;
    is_last_ = row + strip_.rows == plan_->region_.rows;
    aim(strip);
}

// Points the strip at its diagonals and its part of the destination.
void StripWalk::aim(std::ptrdiff_t strip) noexcept {
    double* const lanes = lanes_;
    std::fill_n(lanes, costs * lane_stride_, infinity);
    strip_.before = lanes + values * lane_stride_;
    strip_.before_last = lanes + (values + 1) * lane_stride_;
    strip_.current = lanes + (values + 2) * lane_stride_;
    strip_.cost = lanes + costs * lane_stride_;
    const std::ptrdiff_t first = strip_.next_diagonal;
    if (first > 0) strip_.before_last[0] = strip_.boundary[first - 1];
    const Destination& destination = plan_->destination_;
    if (plan_->output_ == kernels::Output::origins) {
        std::fill_n(lanes + origins * lane_stride_, 3 * lane_stride_, 0.0);
        strip_.origin_before = lanes + origins * lane_stride_;
        strip_.origin_before_last = lanes + (origins + 1) * lane_stride_;
        strip_.origin_current = lanes + (origins + 2) * lane_stride_;
        if (first > 0) strip_.origin_before_last[0] = strip_.origin_boundary[first - 1];
    }
    if (destination.codes != nullptr) {
        const StripCodes& codes = destination.layout[strip];
        strip_.codes = destination.codes + codes.offset - codes.first_diagonal * plan_->height_;
    }
    if (plan_->output_ == kernels::Output::table) {
        strip_.table = destination.table + strip * plan_->height_ * plan_->region_.columns;
    }
}

std::int64_t StripWalk::advance(std::ptrdiff_t end) noexcept {
    if (at_start_) {
        // The 0 above cell (0, 0) starts every path; it is not the diagonal predecessor of another
        // cell.
        advance_(strip_, strip_.next_diagonal + 1, fill_);
        strip_.before_last[0] = infinity;
        at_start_ = false;
    }
    if (narrower_.is_on()) {
        advance_narrowing(end);
    } else {
        advance_(strip_, end, fill_);
    }
    const double share = static_cast<double>(strip_.next_diagonal - first_diagonal_) /
                         static_cast<double>(end_diagonal_ - first_diagonal_);
    const auto count = static_cast<std::int64_t>(share * static_cast<double>(strip_.rows) *
                                                 static_cast<double>(strip_.columns));
    const std::int64_t more = count - counted_;
    counted_ = count;
    return more;
}

void StripWalk::advance_narrowing(std::ptrdiff_t end) noexcept {
    std::ptrdiff_t* const last_column = columns_ + plan_->height_;
    const std::ptrdiff_t stride = StripNarrower::stride(strip_);
    while (strip_.next_diagonal < end) {
        advance_(strip_, std::min(strip_.next_diagonal + stride, end), fill_);
        if (!narrower_.narrow(strip_, columns_, last_column)) {
            end_diagonal_ = strip_.next_diagonal;
            return;
        }
    }
}

bool StripWalk::is_hopeless(double most) const noexcept {
    const auto are_above = [&](const double* first, const double* end) {
        return std::all_of(first, end, [&](double value) { return value > most; });
    };
    // The neighbours of the active lanes are infinite.
    const std::ptrdiff_t low = strip_.low_lane, end = strip_.high_lane + 2;
    if (!are_above(strip_.before + low, strip_.before + end) ||
        !are_above(strip_.before_last + low, strip_.before_last + end)) {
        return false;
    }
    const double* const row = strip_.boundary;
    const std::ptrdiff_t next = strip_.next_diagonal;
    if (!are_above(row + next, row + std::max(strip_.last_column[0] + 1, next))) return false;
    if (is_last_ && !plan_->problem_->open_end) return true;
    const std::ptrdiff_t first_below = strip_.first_column[strip_.rows - 1];
    return are_above(row + first_below, row + std::max(next + 1 - strip_.rows, first_below));
}

std::int64_t StripWalk::leave() noexcept {
    if (narrower_.is_on()) {
        narrower_.leave(strip_, strip_.first_column, strip_.last_column, is_last_);
    }
    return strip_.rows * strip_.columns - counted_;
}

CodeLayout::CodeLayout(const SweepProblem& problem, const Region& region) {
    Destination destination;
    std::uint8_t some_codes = 0;
    destination.codes = &some_codes;
    const StripPlan plan(problem, region, worker_count(problem, region), destination);
    height = plan.height();
    strips.reserve(static_cast<std::size_t>(plan.strips()));
    for (std::ptrdiff_t s = 0; s < plan.strips(); ++s) {
        const std::ptrdiff_t first = plan.columns(s * height).first;
        const std::ptrdiff_t last_row = std::min((s + 1) * height, region.rows) - 1;
        const std::ptrdiff_t end = plan.columns(last_row).last + last_row - s * height + 1;
        strips.push_back({first, size});
        size += (end - first) * height + kernels::padding;
    }
}

}  // namespace curvewise::warping
