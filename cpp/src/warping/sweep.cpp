#include "warping/sweep.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "runtime/scratch.hpp"
#include "runtime/workers.hpp"
#include "warping/strip_walk.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The approximate time of a cell, relative to the fastest.
std::ptrdiff_t cell_weight(const SweepProblem& problem) noexcept {
    const GroundDistance ground{problem.cost.metric};
    return static_cast<std::ptrdiff_t>(ground.weight(static_cast<double>(problem.curves.dim())));
}

// Columns between two polls and tests of other threads' progress: about 10^5 cells, 50 to 200 µs,
// or fewer if a cell has many coordinates.
std::ptrdiff_t chunk_of(const SweepProblem& problem) noexcept {
    return std::clamp<std::ptrdiff_t>(4096 / cell_weight(problem), 1, 1024);
}

// The same for threads that share a narrowed strip, which has few active columns.
constexpr std::ptrdiff_t narrow_chunk = 64;

// The same between two tests of whether a sweep gives up.
constexpr std::ptrdiff_t give_up_chunk = 32;

// Whether a sweep gives up within its strips.
bool gives_up_early(const SweepProblem& problem, const StripPlan& plan,
                    bool is_narrowing) noexcept {
    return problem.give_up_above < infinity && !is_narrowing && !plan.is_resident();
}

// Sweeps a strip, or less where all that follows is above `most`. Whether to stop.
bool sweep_strip(StripWalk& walk, std::ptrdiff_t strip, std::ptrdiff_t chunk, double most,
                 std::ptrdiff_t weight, Poller& poller) {
    walk.enter(strip);
    walk.above_is_finished();
    while (walk.next_diagonal() < walk.end_diagonal()) {
        const std::ptrdiff_t end = std::min(walk.next_diagonal() + chunk, walk.end_diagonal());
        if (poller.count_steps(walk.advance(end), weight)) return true;
        if (most < infinity && walk.is_hopeless(most)) break;
    }
    return poller.count_steps(walk.leave(), weight);
}

bool is_hopeless(const SweepProblem& problem, const Region& region, const double* row) noexcept {
    return problem.give_up_above < infinity &&
           std::all_of(row, row + region.columns,
                       [&](double value) { return value > problem.give_up_above; });
}

// Counts the strips from `strip` on as done.
void skip_rest(const SweepProblem& problem, const StripPlan& plan, std::ptrdiff_t strip) {
    const std::ptrdiff_t rows = problem.curves.rows() - strip * plan.height();
    problem.poller.count_steps(std::max<std::ptrdiff_t>(rows, 0) * problem.curves.columns());
}

// Takes strips from the pipeline until it is empty, or until the poller stops.
void sweep_in_turn(StripWalk& walk, std::ptrdiff_t chunk, std::ptrdiff_t weight,
                   runtime::Pipeline& pipeline, Poller& poller) {
    for (std::ptrdiff_t s = pipeline.take(); s >= 0; s = pipeline.take()) {
        if (!pipeline.wait(s, walk.columns_to_enter(s), poller)) return;
        walk.enter(s);
        while (walk.next_diagonal() < walk.end_diagonal()) {
            const std::ptrdiff_t end = std::min(walk.next_diagonal() + chunk, walk.end_diagonal());
            if (!pipeline.wait(s, end, poller)) return;
            if (pipeline.is_finished(s - 1)) walk.above_is_finished();
            const std::int64_t cells = walk.advance(end);
            pipeline.publish(s, walk.finished_columns());
            if (poller.count_steps(cells, weight)) return;
        }
        const std::int64_t rest = walk.leave();
        pipeline.finish(s);
        if (poller.count_steps(rest, weight)) return;
    }
}

// What the walks of a narrowing sweep, and the strips one by one, have found.
void gather(const StripWalk& first, const std::vector<StripWalk>& others, SweptColumns& swept) {
    swept.cells += first.narrowed_cells();
    for (const StripWalk& walk : others) swept.cells += walk.narrowed_cells();
    ColumnRange range{0, -1};
    for (ColumnRange& row : swept.rows) {
        range = {std::max(range.first, row.first), std::max(range.last, row.last)};
        row = range;
    }
}

// All of the table; returns its last row.
const Row& sweep_all(const SweepProblem& problem, const Destination& destination) {
    Row& row = problem.memory.row;
    assign_start(problem, problem.curves.columns(), row);
    sweep(problem, whole_table(problem.curves), !problem.open_begin, row.data(), destination);
    return row;
}

}  // namespace

void sweep(const SweepProblem& problem, const Region& region, bool starts_here, double* boundary,
           const Destination& destination) {
    const StripPlan plan(problem, region, worker_count(problem, region), destination);
    const bool is_narrowing = problem.columns.cost_to_go() != nullptr;
    runtime::ScratchVector<StripEdge> edges;
    if (is_narrowing) {
        edges.resize(static_cast<std::size_t>(plan.strips() + 1));
        edges[0].last = starts_here ? 0 : region.columns - 1;
        problem.columns.swept()->rows.resize(static_cast<std::size_t>(region.rows));
    }
    StripWalk first(plan, starts_here, boundary, problem.memory, edges.data());
    runtime::ScratchVector<SweepMemory> memories(static_cast<std::size_t>(plan.workers() - 1));
    std::vector<StripWalk> others;
    others.reserve(memories.size());
    for (SweepMemory& memory : memories) {
        others.emplace_back(plan, starts_here, boundary, memory, edges.data());
    }
    const std::ptrdiff_t weight = cell_weight(problem);
    if (others.empty()) {
        const bool gives_up = gives_up_early(problem, plan, is_narrowing);
        const double most = gives_up ? problem.give_up_above : infinity;
        const std::ptrdiff_t chunk =
            gives_up ? std::min(chunk_of(problem), give_up_chunk) : chunk_of(problem);
        for (std::ptrdiff_t s = 0; s < plan.strips(); ++s) {
            if (problem.own != nullptr) first.ask_for_distances(s);
            if (sweep_strip(first, s, chunk, most, weight, problem.poller)) throw Stopped();
            if (first.next_diagonal() < first.end_diagonal()) {
                std::fill_n(boundary, region.columns, infinity);
            }
            if (is_hopeless(problem, region, boundary)) return skip_rest(problem, plan, s + 1);
        }
    } else {
        const std::ptrdiff_t chunk =
            is_narrowing ? std::min(chunk_of(problem), narrow_chunk) : chunk_of(problem);
        runtime::Pipeline pipeline(plan.strips());
        runtime::run_workers(plan.workers(), problem.poller, [&](std::ptrdiff_t w, Poller& poller) {
            StripWalk& walk = w == 0 ? first : others[static_cast<std::size_t>(w - 1)];
            sweep_in_turn(walk, chunk, weight, pipeline, poller);
        });
        problem.poller.throw_if_stopped();
    }
    if (is_narrowing) gather(first, others, *problem.columns.swept());
}

double lone_cell(const SweepProblem& problem, std::ptrdiff_t row, std::ptrdiff_t column) {
    SweepProblem cell = problem;
    cell.columns = Band(1, 1, std::nullopt);
    Row above(1, 0.0);
    sweep(cell, {row, 1, column, 1}, true, above.data(), {});
    return above[0];
}

const Row& last_row(const SweepProblem& problem) { return sweep_all(problem, {}); }

void sweep_table(const SweepProblem& problem, double* table) {
    if (problem.columns.is_limited()) {
        const std::ptrdiff_t columns = problem.curves.columns();
        problem.poller.in_runs(problem.curves.rows(), columns, [&](auto first, auto end) {
            std::fill(table + first * columns, table + end * columns, infinity);
        });
    }
    Destination destination;
    destination.table = table;
    sweep_all(problem, destination);
}

}  // namespace curvewise::warping
