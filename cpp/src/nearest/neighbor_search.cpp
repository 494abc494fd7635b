#include "nearest/neighbor_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nearest/own_count.hpp"

namespace curvewise::nearest {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Leaves lie apart in memory. If a search needs more of them than these, or an eighth of all, it is
// faster to read all first bounds in order.
constexpr std::ptrdiff_t few_leaves = 256;

// What a bound takes, for the poller: some microseconds.
constexpr std::int64_t bound_effort = 1 << 11;

void poll(Poller& poller, std::int64_t effort) {
    if (poller.count_steps(effort)) throw Stopped();
}

void count(Poller& poller, std::int64_t steps) {
    poller.set_counting(true);
    poller.count_steps(steps, 0);
    poller.set_counting(false);
}

}  // namespace

bool is_nearer(const Neighbor& a, const Neighbor& b) noexcept {
    if (a.distance < b.distance) return true;
    if (b.distance < a.distance) return false;
    const bool a_is_nan = std::isnan(a.distance), b_is_nan = std::isnan(b.distance);
    return a_is_nan == b_is_nan ? a.index < b.index : b_is_nan;
}

NeighborSearch::NeighborSearch(const pairwise::Targets& targets, const pairwise::Seen& seen,
                               Poller& poller)
    : seen_(seen),
      poller_(poller),
      memory_(targets.make_memory()),
      quick_(static_cast<std::size_t>(BoundTree::leaf_rows)) {}

const std::vector<BoundForest::Planted>& NeighborSearch::trees() const noexcept {
    static const std::vector<BoundForest::Planted> none;
    return seen_.forest == nullptr ? none : seen_.forest->trees();
}

std::ptrdiff_t NeighborSearch::planted() const noexcept {
    return seen_.forest == nullptr ? 0 : seen_.forest->size();
}

void NeighborSearch::bound(TargetQuery& query, std::ptrdiff_t first, std::ptrdiff_t end) {
    quick_.resize(static_cast<std::size_t>(std::max(end - first, BoundTree::leaf_rows)));
    query.quick(first, end - first, quick_.data());
    first_bounds_ += end - first;
}

std::ptrdiff_t NeighborSearch::all_leaves() const noexcept {
    std::ptrdiff_t all = 0;
    for (const BoundForest::Planted& planted : trees()) all += planted.tree->boxes(0);
    return all;
}

BoundTree::Leaf NeighborSearch::held(const OpenLeaf& leaf) const noexcept {
    return trees()[static_cast<std::size_t>(leaf.tree)].tree->leaf(leaf.place);
}

template <class Use>
void NeighborSearch::for_targets(const OpenLeaf& leaf, Use use) const {
    const std::ptrdiff_t first = trees()[static_cast<std::size_t>(leaf.tree)].first;
    const BoundTree::Leaf targets = held(leaf);
    for (std::ptrdiff_t k = 0; k < targets.count; ++k) use(first + targets.places[k], k);
}

void NeighborSearch::bound(TargetQuery& query, const OpenLeaf& leaf) {
    query.quick(trees()[static_cast<std::size_t>(leaf.tree)].first, held(leaf), quick_.data());
    first_bounds_ += held(leaf).count;
}

NeighborSearch::BoxBounds NeighborSearch::bounds_of(TargetQuery& query, const BoundTree& tree,
                                                    int level, std::ptrdiff_t first) {
    BoxBounds boxes{{}, std::min(BoundTree::fan, tree.boxes(level) - first)};
    query.of_boxes(tree.box(level, first), boxes.count, boxes.bounds);
    return boxes;
}

runtime::ScratchVector<Neighbor>& NeighborSearch::answer(TargetQuery& query, std::int64_t all_steps,
                                                         const Question& question,
                                                         LeftOut left_out) {
    const OwnCount own_count(poller_);
    counted_ = 0;
    first_bounds_ = 0;
    leave_out(left_out);
    found_.begin(question);
    leaves_.clear();
    if (question.count > 0) {
        find_nearest(query);
    } else {
        find_within(query, question);
    }
    count(poller_, all_steps - counted_);
    return found_.sorted();
}

void NeighborSearch::find_nearest(TargetQuery& query) {
    heap_.clear();
    most_leaves_ = static_cast<std::size_t>(std::max(few_leaves, all_leaves() / 8));
    for (std::size_t t = 0; t < trees().size(); ++t) {
        push_boxes(query, static_cast<int>(t), trees()[t].tree->levels() - 1, 0);
    }
    const std::ptrdiff_t first = planted();
    bound(query, first, seen_.size);
    for (std::ptrdiff_t j = first; j < seen_.size; ++j) {
        if (is_wanted(j)) heap_.push_back({quick_[static_cast<std::size_t>(j - first)], j, 0});
    }
    std::make_heap(heap_.begin(), heap_.end(), ComesLater());
    while (!heap_.empty() && !(heap_.front().bound > cutoff())) {
        std::pop_heap(heap_.begin(), heap_.end(), ComesLater());
        const Candidate candidate = heap_.back();
        heap_.pop_back();
        if (candidate.target < 0) {
            look_into(query, candidate);
        } else {
            look_at(query, candidate);
        }
    }
}

void NeighborSearch::leave_out(LeftOut targets) noexcept {
    left_out_ = targets;
    record_.pairs += seen_.remaining;
    for (std::ptrdiff_t j = targets.first; j <= targets.last; ++j) record_.pairs -= seen_.has(j);
}

void NeighborSearch::push(const Candidate& candidate) {
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end(), ComesLater());
}

void NeighborSearch::push_boxes(TargetQuery& query, int tree, int level, std::ptrdiff_t first) {
    const BoxBounds boxes =
        bounds_of(query, *trees()[static_cast<std::size_t>(tree)].tree, level, first);
    const double most = cutoff();
    for (std::ptrdiff_t b = 0; b < boxes.count; ++b) {
        if (!(boxes.bounds[b] > most)) push({boxes.bounds[b], ~(first + b), level, tree});
    }
}

void NeighborSearch::look_into(TargetQuery& query, const Candidate& box) {
    const std::ptrdiff_t place = ~box.target;
    poll(poller_, bound_effort);
    if (box.level > 0) {
        return push_boxes(query, box.tree, box.level - 1, place * BoundTree::fan);
    }
    if (leaves_.size() == most_leaves_) return look_into_all(query);
    leaves_.push_back({place, box.tree});
    bound(query, leaves_.back());
    const double most = cutoff();
    for_targets(leaves_.back(), [&](std::ptrdiff_t target, std::ptrdiff_t k) {
        const double bound = quick_[static_cast<std::size_t>(k)];
        if (!(bound > most) && is_wanted(target)) push({bound, target, 0});
    });
}

// The targets that are in no leaf so far, in the order of their memory.
void NeighborSearch::look_into_all(TargetQuery& query) {
    const auto is_box = [](const Candidate& candidate) { return candidate.target < 0; };
    heap_.erase(std::remove_if(heap_.begin(), heap_.end(), is_box), heap_.end());
    clear_marks();
    for (const OpenLeaf& leaf : leaves_) {
        for_targets(leaf, [&](std::ptrdiff_t target, std::ptrdiff_t /*k*/) { mark(target); });
    }
    bound(query, 0, planted());
    const double most = cutoff();
    for (std::ptrdiff_t j = 0; j < planted(); ++j) {
        const double bound = quick_[static_cast<std::size_t>(j)];
        if (!(bound > most) && !is_marked(j) && is_wanted(j)) heap_.push_back({bound, j, 0});
    }
    std::make_heap(heap_.begin(), heap_.end(), ComesLater());
}

// Raises the bound until another candidate comes first, or no candidate remains.
void NeighborSearch::look_at(TargetQuery& query, Candidate candidate) {
    if (candidate.level == 0 && query.levels() > 1) ++record_.refined;
    while (candidate.level + 1 < query.levels()) {
        ++candidate.level;
        candidate.bound =
            std::max(candidate.bound, refined(query, candidate.target, candidate.level));
        if (candidate.bound > cutoff()) return finish_pair(query, candidate.target);
        if (!heap_.empty() && ComesLater()(candidate, heap_.front())) return push(candidate);
    }
    found_.keep({candidate.target, value(query, candidate.target, cutoff())});
    finish_pair(query, candidate.target);
}

void NeighborSearch::find_within(TargetQuery& query, const Question& question) {
    const double radius = question.radius;
    const auto look_at = [&](std::ptrdiff_t target) {
        if (is_wanted(target)) look_within(query, target, question);
    };
    const std::ptrdiff_t half = all_leaves() / 2;
    most_leaves_ = static_cast<std::size_t>(std::max(std::min(few_leaves, half), half / 4));
    for (std::size_t t = 0; t < trees().size(); ++t) {
        find_leaves(query, static_cast<int>(t), trees()[t].tree->levels() - 1, 0, radius);
    }
    std::ptrdiff_t first = 0;
    if (leaves_.size() <= most_leaves_) {
        first = planted();
        for_marked_within(query, radius, look_at);
    }
    bound(query, first, seen_.size);
    for (std::ptrdiff_t j = first; j < seen_.size; ++j) {
        if (!(quick_[static_cast<std::size_t>(j - first)] > radius)) look_at(j);
    }
}

// In the order of the targets, which trees do not have.
template <class LookAt>
void NeighborSearch::for_marked_within(TargetQuery& query, double radius, LookAt look_at) {
    clear_marks();
    for (const OpenLeaf& leaf : leaves_) {
        bound(query, leaf);
        for_targets(leaf, [&](std::ptrdiff_t target, std::ptrdiff_t k) {
            if (!(quick_[static_cast<std::size_t>(k)] > radius)) mark(target);
        });
    }
    for (std::size_t w = 0; w < marks_.size(); ++w) {
        auto target = static_cast<std::ptrdiff_t>(64 * w);
        for (std::uint64_t marks = marks_[w]; marks != 0; marks >>= 1, ++target) {
            if ((marks & 1) != 0) look_at(target);
        }
    }
}

void NeighborSearch::find_leaves(TargetQuery& query, int tree, int level, std::ptrdiff_t first,
                                 double radius) {
    const BoxBounds boxes =
        bounds_of(query, *trees()[static_cast<std::size_t>(tree)].tree, level, first);
    poll(poller_, bound_effort);
    for (std::ptrdiff_t b = 0; b < boxes.count && leaves_.size() <= most_leaves_; ++b) {
        if (boxes.bounds[b] > radius) continue;
        if (level > 0) {
            find_leaves(query, tree, level - 1, (first + b) * BoundTree::fan, radius);
        } else {
            leaves_.push_back({first + b, tree});
        }
    }
}

void NeighborSearch::look_within(TargetQuery& query, std::ptrdiff_t target,
                                 const Question& question) {
    const int levels = query.levels();
    if (levels > 1) ++record_.refined;
    int level = 1;
    while (level < levels && !(refined(query, target, level) > question.radius)) ++level;
    if (level >= levels) found_.keep({target, distance_within(query, target, question)});
    finish_pair(query, target);
}

double NeighborSearch::refined(TargetQuery& query, std::ptrdiff_t target, int level) {
    poll(poller_, bound_effort);
    return query.refined(target, level);
}

double NeighborSearch::value(TargetQuery& query, std::ptrdiff_t target, double cutoff) {
    ++record_.computed;
    const double distance = query.value(target, {cutoff, 1, poller_, *memory_});
    poll(poller_, query.steps(target));
    return distance;
}

double NeighborSearch::distance_within(TargetQuery& query, std::ptrdiff_t target,
                                       const Question& question) {
    if (question.with_distances) return value(query, target, question.radius);
    ++record_.computed;
    const bool is_within = query.is_within(target, {question.radius, 1, poller_, *memory_});
    poll(poller_, query.steps(target));
    return is_within ? -infinity : std::numeric_limits<double>::quiet_NaN();
}

void NeighborSearch::finish_pair(TargetQuery& query, std::ptrdiff_t target) {
    const std::int64_t steps = query.steps(target);
    counted_ += steps;
    count(poller_, steps);
}

}  // namespace curvewise::nearest
