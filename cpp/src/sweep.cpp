#include "sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>

#include "strip_walk.hpp"
#include "workers.hpp"

namespace curvewise::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The time a cell takes, roughly, in that of the fastest.
std::ptrdiff_t cell_weight(const SweepProblem& problem) noexcept {
    constexpr std::ptrdiff_t power = 16;
    return problem.curves.dim() * (problem.cost == kernels::Cost::minkowski ? power : 1);
}

// Columns between two looks at the watch and at what other threads have done: some 10^5 cells, 50
// to 200 µs, or fewer where a cell has many coordinates.
std::ptrdiff_t chunk_of(const SweepProblem& problem) noexcept {
    return std::clamp<std::ptrdiff_t>(4096 / cell_weight(problem), 1, 1024);
}

std::ptrdiff_t worker_count(const SweepProblem& problem, const Region& region) noexcept {
    const std::ptrdiff_t useful = region.rows * region.columns / problem.cells_per_worker;
    return std::max<std::ptrdiff_t>(1, std::min(problem.workers, useful));
}

// Whether to stop.
bool sweep_strip(StripWalk& walk, std::ptrdiff_t strip, std::ptrdiff_t chunk, std::ptrdiff_t weight,
                 Watch& watch) {
    walk.enter(strip);
    while (walk.next_diagonal() < walk.end_diagonal()) {
        const std::ptrdiff_t end = std::min(walk.next_diagonal() + chunk, walk.end_diagonal());
        if (watch.step(walk.advance(end), weight)) return true;
    }
    return false;
}

bool is_hopeless(const SweepProblem& problem, const Region& region, const double* row) noexcept {
    return problem.give_up_above < infinity &&
           std::all_of(row, row + region.columns,
                       [&](double value) { return value > problem.give_up_above; });
}

// Counts the strips from `strip` on as done.
void skip_rest(const SweepProblem& problem, const StripPlan& plan, std::ptrdiff_t strip) {
    const std::ptrdiff_t rows = problem.curves.rows() - strip * plan.height();
    problem.watch.step(std::max<std::ptrdiff_t>(rows, 0) * problem.curves.columns());
}

// Takes strips from the pipeline until none is left, or the watch says stop.
void sweep_in_turn(StripWalk& walk, std::ptrdiff_t chunk, std::ptrdiff_t weight, Pipeline& pipeline,
                   Watch& watch) {
    for (std::ptrdiff_t s = pipeline.take(); s >= 0; s = pipeline.take()) {
        if (!pipeline.wait(s, walk.first_diagonal_of(s), watch)) return;
        walk.enter(s);
        while (walk.next_diagonal() < walk.end_diagonal()) {
            const std::ptrdiff_t end = std::min(walk.next_diagonal() + chunk, walk.end_diagonal());
            if (!pipeline.wait(s, end, watch)) return;
            const std::int64_t cells = walk.advance(end);
            pipeline.publish(s, walk.finished_columns());
            if (watch.step(cells, weight)) return;
        }
        pipeline.finish(s);
    }
}

// All of the table; returns its last row.
const Row& sweep_all(const SweepProblem& problem, const Destination& destination) {
    // The virtual row above the table: 0 where a path may begin.
    Row& row = problem.memory.row;
    row.assign(problem.curves.columns(), problem.open_begin ? 0.0 : infinity);
    row[0] = 0.0;
    sweep(problem, whole_table(problem.curves), !problem.open_begin, row.data(), destination);
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

kernels::Cost canonical_cost(const GroundDistance& ground, const PackedPair& curves) noexcept {
    if (ground.metric == Metric::sqeuclidean) return kernels::Cost::sqeuclidean;
    if (curves.dim() == 1) return kernels::Cost::cityblock;
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
    return curves.squares_are_in_domain() ? kernels::Cost::euclidean_in_domain
                                          : kernels::Cost::euclidean;
}

Region whole_table(const PackedPair& curves) noexcept {
    return {0, curves.rows(), 0, curves.columns()};
}

void Row::assign(std::ptrdiff_t columns, double value) {
    columns_ = columns;
    row_.reserve(columns + StripWalk::max_height + kernels::padding);
    std::fill_n(row_.data(), columns, value);
}

std::ptrdiff_t Row::argmin() const noexcept {
    return std::min_element(row_.data(), row_.data() + columns_) - row_.data();
}

void sweep(const SweepProblem& problem, const Region& region, bool starts_here, double* boundary,
           const Destination& destination) {
    const StripPlan plan(problem, region, worker_count(problem, region), destination);
    const std::ptrdiff_t chunk = chunk_of(problem), weight = cell_weight(problem);
    if (plan.workers() == 1) {
        StripWalk walk(plan, starts_here, boundary, problem.memory);
        for (std::ptrdiff_t s = 0; s < plan.strips(); ++s) {
            if (sweep_strip(walk, s, chunk, weight, problem.watch)) throw Stopped();
            if (is_hopeless(problem, region, boundary)) return skip_rest(problem, plan, s + 1);
        }
        return;
    }
    std::vector<SweepMemory> memories(static_cast<std::size_t>(plan.workers()));
    std::vector<StripWalk> walks;
    walks.reserve(memories.size());
    for (SweepMemory& memory : memories) walks.emplace_back(plan, starts_here, boundary, memory);
    Pipeline pipeline(plan.strips());
    run_workers(plan.workers(), problem.watch, [&](std::ptrdiff_t w, Watch& watch) {
        sweep_in_turn(walks[static_cast<std::size_t>(w)], chunk, weight, pipeline, watch);
    });
    problem.watch.throw_if_stopped();
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
        size += (end - first) * height;
    }
}

double lone_cell(const SweepProblem& problem, std::ptrdiff_t row, std::ptrdiff_t column) {
    SweepProblem cell = problem;
    cell.band = Band(1, 1, std::nullopt);
    Row above(1, 0.0);
    sweep(cell, {row, 1, column, 1}, true, above.data(), {});
    return above[0];
}

const Row& last_row(const SweepProblem& problem) { return sweep_all(problem, {}); }

void sweep_table(const SweepProblem& problem, double* table) {
    if (problem.band.is_limited()) {
        std::fill_n(table, problem.curves.rows() * problem.curves.columns(), infinity);
    }
    Destination destination;
    destination.table = table;
    sweep_all(problem, destination);
}

}  // namespace curvewise::detail
