#include "nearest/neighbor_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewise::nearest {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// What a bound takes, for the poller: some microseconds.
constexpr std::int64_t bound_effort = 1 << 11;

// A search counts whole pairs, so the computation of a distance must not count them again.
class OwnCount {
   public:
    explicit OwnCount(Poller& poller) noexcept
        : poller_(poller), was_counting_(poller.set_counting(false)) {}
    OwnCount(const OwnCount&) = delete;
    OwnCount(OwnCount&&) = delete;
    OwnCount& operator=(const OwnCount&) = delete;
    OwnCount& operator=(OwnCount&&) = delete;
    ~OwnCount() { poller_.set_counting(was_counting_); }

   private:
    Poller& poller_;
    bool was_counting_;
};

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
    : seen_(seen), poller_(poller), memory_(targets.make_memory()) {}

bool NeighborSearch::comes_later(const Candidate& a, const Candidate& b) noexcept {
    return a.bound != b.bound ? a.bound > b.bound : a.target > b.target;
}

std::vector<Neighbor> NeighborSearch::nearest(TargetQuery& query, std::int64_t all_steps,
                                              std::ptrdiff_t count_wanted,
                                              std::ptrdiff_t left_out) {
    const OwnCount own_count(poller_);
    counted_ = 0;
    most_ = static_cast<std::size_t>(count_wanted);
    best_.clear();
    heap_.clear();
    quick_.resize(static_cast<std::size_t>(seen_.size));
    query.quick(quick_.data());
    for (std::ptrdiff_t j = 0; j < seen_.size; ++j) {
        if (j != left_out && seen_.has(j))
            heap_.push_back({quick_[static_cast<std::size_t>(j)], j, 0});
    }
    record_.pairs += static_cast<std::int64_t>(heap_.size());
    std::make_heap(heap_.begin(), heap_.end(), comes_later);
    while (!heap_.empty() && !(heap_.front().bound > cutoff())) {
        std::pop_heap(heap_.begin(), heap_.end(), comes_later);
        const Candidate candidate = heap_.back();
        heap_.pop_back();
        look_at(query, candidate);
    }
    count(poller_, all_steps - counted_);
    std::sort(best_.begin(), best_.end(), is_nearer);
    return best_;
}

// Raises the bound until another candidate comes first, or no candidate remains.
void NeighborSearch::look_at(TargetQuery& query, Candidate candidate) {
    if (candidate.level == 0 && query.levels() > 1) ++record_.refined;
    while (candidate.level + 1 < query.levels()) {
        ++candidate.level;
        candidate.bound = refined(query, candidate);
        if (candidate.bound > cutoff()) return finish_pair(query, candidate.target);
        if (!heap_.empty() && comes_later(candidate, heap_.front())) {
            heap_.push_back(candidate);
            std::push_heap(heap_.begin(), heap_.end(), comes_later);
            return;
        }
    }
    keep_if_near({candidate.target, value(query, candidate.target, cutoff())});
    finish_pair(query, candidate.target);
}

std::vector<Neighbor> NeighborSearch::within(TargetQuery& query, std::int64_t all_steps,
                                             double radius, bool with_distances,
                                             std::ptrdiff_t left_out) {
    const OwnCount own_count(poller_);
    counted_ = 0;
    std::vector<Neighbor> found;
    quick_.resize(static_cast<std::size_t>(seen_.size));
    query.quick(quick_.data());
    for (std::ptrdiff_t j = 0; j < seen_.size; ++j) {
        if (j == left_out || !seen_.has(j)) continue;
        ++record_.pairs;
        Candidate candidate{quick_[static_cast<std::size_t>(j)], j, 0};
        if (candidate.bound > radius) continue;
        if (query.levels() > 1) ++record_.refined;
        while (candidate.bound <= radius && candidate.level + 1 < query.levels()) {
            ++candidate.level;
            candidate.bound = refined(query, candidate);
        }
        if (candidate.bound <= radius) {
            const std::optional<double> distance =
                distance_within(query, j, radius, with_distances);
            if (distance) found.push_back({j, *distance});
        }
        finish_pair(query, j);
    }
    count(poller_, all_steps - counted_);
    return found;
}

double NeighborSearch::refined(TargetQuery& query, const Candidate& candidate) {
    poll(poller_, bound_effort);
    return std::max(candidate.bound, query.refined(candidate.target, candidate.level));
}

double NeighborSearch::value(TargetQuery& query, std::ptrdiff_t target, double cutoff) {
    ++record_.computed;
    const double distance = query.value(target, {cutoff, 1, poller_, *memory_});
    poll(poller_, query.steps(target));
    return distance;
}

std::optional<double> NeighborSearch::distance_within(TargetQuery& query, std::ptrdiff_t target,
                                                      double radius, bool is_wanted) {
    if (is_wanted) {
        const double distance = value(query, target, radius);
        return distance <= radius ? std::optional<double>(distance) : std::nullopt;
    }
    ++record_.computed;
    const bool is_within = query.is_within(target, {radius, 1, poller_, *memory_});
    poll(poller_, query.steps(target));
    return is_within ? std::optional<double>(std::numeric_limits<double>::quiet_NaN())
                     : std::nullopt;
}

void NeighborSearch::keep_if_near(const Neighbor& found) {
    if (best_.size() == most_) {
        if (!is_nearer(found, best_.front())) return;
        std::pop_heap(best_.begin(), best_.end(), is_nearer);
        best_.pop_back();
    }
    best_.push_back(found);
    std::push_heap(best_.begin(), best_.end(), is_nearer);
}

double NeighborSearch::cutoff() const noexcept {
    if (best_.size() < most_ || std::isnan(best_.front().distance)) return infinity;
    return best_.front().distance;
}

void NeighborSearch::finish_pair(TargetQuery& query, std::ptrdiff_t target) {
    const std::int64_t steps = query.steps(target);
    counted_ += steps;
    count(poller_, steps);
}

}  // namespace curvewise::nearest
