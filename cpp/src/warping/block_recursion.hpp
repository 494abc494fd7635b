// The table of the Fréchet distance, divided into blocks over the runs of two box trees. A block is
// settled without its cells in two cases:
//
//   blocked: no cell that leads into it has been reached, or its smallest ground distance is above
//     `upper`. Nothing comes out of it.
//   free: its largest ground distance is at most `lower`, a lower bound of the answer. Values pass
//     through it, the smallest of them to each cell behind.
//
// Other blocks are split, down to `block_side` points, and then swept. Cells are kept only along
// the front between finished and unfinished blocks: one value for each point of either curve. The
// Front defines the kind of value, and how it passes through a block: whether a cell has been
// reached (reach.hpp), or the cell of the table (block_values.hpp).
//
// Similar curves stay near each other along a narrow part of the table only. There the blocks that
// are neither free nor blocked lie along two lines. So the time is nearly linear. At worst it is
// O(n m), in blocks that a sweep handles in much less time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "curvewise/control.hpp"
#include "runtime/poller.hpp"
#include "warping/box_tree.hpp"
#include "warping/kernels/block.hpp"

namespace curvewise::warping {

// Runs of `block_side` points: the grain of the front.
struct RunRange {
    std::ptrdiff_t first;
    std::ptrdiff_t end;
};

inline constexpr std::ptrdiff_t block_level = 3;
static_assert(BoxTree::leaf_points << block_level == kernels::block_side);

inline std::ptrdiff_t runs_of(std::ptrdiff_t points) noexcept {
    return (points + kernels::block_side - 1) / kernels::block_side;
}

// What a recursion has done.
struct BlockCounts {
    std::int64_t blocks = 0;       // looked at
    std::int64_t swept_cells = 0;  // in those that were swept
};

template <class Norm, class Front>
class BlockRecursion {
   public:
    // All of it counts as `steps` of work.
    BlockRecursion(const BoxTree& P, const BoxTree& Q, double lower, double upper, Front& front,
                   Poller& poller, std::int64_t steps) noexcept
        : P_(P),
          Q_(Q),
          lower_(lower),
          upper_(upper),
          front_(front),
          poller_(poller),
          steps_(steps) {}

    // `corner`: the value that leads into the first cell.
    void run(typename Front::Value corner) {
        visit({P_.levels() - 1, 0}, {Q_.levels() - 1, 0}, corner);
        poller_.count_steps(steps_ - counted_steps_, 0);
    }
    const BlockCounts& counts() const noexcept { return counts_; }

   private:
    // About 20 µs of work; testing a block takes as long as sweeping some cells.
    static constexpr std::int64_t effort_between_polls = 1 << 16;
    static constexpr std::int64_t effort_of_a_block = 256;

    struct Box {
        std::ptrdiff_t level;
        std::ptrdiff_t index;
        Box child(std::ptrdiff_t which) const noexcept { return {level - 1, 2 * index + which}; }
    };

    static RunRange runs(const BoxTree& tree, const Box& box) noexcept {
        const std::ptrdiff_t shift = std::max<std::ptrdiff_t>(box.level - block_level, 0);
        return {box.index << shift, std::min((box.index + 1) << shift, runs_of(tree.size()))};
    }

    void visit(const Box& p, const Box& q, typename Front::Value corner) {
        ++counts_.blocks;
        const RunRange rows = runs(P_, p), columns = runs(Q_, q);
        const double* const p_box = P_.box(p.level, p.index);
        const double* const q_box = Q_.box(q.level, q.index);
        std::int64_t effort = effort_of_a_block;
        if (!front_.is_entered(rows, columns, corner) ||
            smallest_distance<Norm>(p_box, q_box, P_.dim()) > upper_) {
            front_.block(rows, columns);
        } else if (largest_distance<Norm>(p_box, q_box, P_.dim()) <= lower_) {
            front_.pass(rows, columns, corner);
        } else if (p.level <= block_level && q.level <= block_level) {
            const std::int64_t cells = front_.sweep(rows.first, columns.first, corner);
            counts_.swept_cells += cells;
            effort += cells * P_.dim();
        } else {
            split(p, q, corner);
            return;
        }
        settle(points_in(P_, rows) * points_in(Q_, columns), effort);
    }

    // Counts cells that are done, and polls now and then.
    void settle(double cells, std::int64_t effort) {
        settled_cells_ += cells;
        effort_ += effort;
        if (effort_ < effort_between_polls) return;
        effort_ = 0;
        const double share =
            settled_cells_ / (static_cast<double>(P_.size()) * static_cast<double>(Q_.size()));
        const auto steps = static_cast<std::int64_t>(share * static_cast<double>(steps_));
        poller_.count_steps(steps - counted_steps_, 0);
        counted_steps_ = steps;
        if (poller_.poll()) throw Stopped();
    }

    static double points_in(const BoxTree& tree, const RunRange& runs) noexcept {
        return static_cast<double>(std::min(runs.end * kernels::block_side, tree.size()) -
                                   runs.first * kernels::block_side);
    }

    // Splits the longer side, or both if they have the same level. The values that lead into the
    // first cell of a part stay on the front until the part before it is done.
    void split(const Box& p, const Box& q, typename Front::Value corner) {
        const bool both = p.level == q.level;
        const std::ptrdiff_t p_parts = p.level < q.level ? 1 : parts(P_, p);
        const std::ptrdiff_t q_parts = q.level < p.level ? 1 : parts(Q_, q);
        const Box p_first = both || p.level > q.level ? p.child(0) : p;
        const Box q_first = both || q.level > p.level ? q.child(0) : q;
        const std::ptrdiff_t p_middle = runs(P_, p_first).end, q_middle = runs(Q_, q_first).end;
        typename Front::Value below{}, right{}, behind{};
        if (p_parts == 2) below = front_.p_value_before(p_middle);
        if (q_parts == 2) right = front_.q_value_before(q_middle);
        visit(p_first, q_first, corner);
        if (p_parts == 2 && q_parts == 2) behind = front_.p_value_before(p_middle);
        if (p_parts == 2) visit(next(p_first), q_first, below);
        if (q_parts == 2) visit(p_first, next(q_first), right);
        if (p_parts == 2 && q_parts == 2) visit(next(p_first), next(q_first), behind);
    }

    static Box next(const Box& box) noexcept { return {box.level, box.index + 1}; }
    static std::ptrdiff_t parts(const BoxTree& tree, const Box& box) noexcept {
        return 2 * box.index + 1 < tree.boxes(box.level - 1) ? 2 : 1;
    }

    const BoxTree& P_;
    const BoxTree& Q_;
    double lower_;
    double upper_;
    Front& front_;
    Poller& poller_;
    BlockCounts counts_;
    std::int64_t steps_;
    double settled_cells_ = 0.0;
    std::int64_t counted_steps_ = 0;
    std::int64_t effort_ = 0;
};

}  // namespace curvewise::warping
