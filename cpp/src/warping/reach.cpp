#include "warping/reach.hpp"

#include <algorithm>

#include "runtime/scratch.hpp"

namespace curvewise::warping {
namespace {

using Word = std::uint64_t;

bool any(const Word* words, const RunRange& runs) noexcept {
    return std::any_of(words + runs.first, words + runs.end, [](Word word) { return word != 0; });
}

// All bits from the first that is set, or all. Those behind the last point are so set together with
// its own, and never alone.
void flood(Word* words, const RunRange& runs, bool from_the_start) noexcept {
    Word* const end = words + runs.end;
    Word* word = words + runs.first;
    if (!from_the_start) {
        word = std::find_if(word, end, [](Word w) { return w != 0; });
        if (word == end) return;
        *word |= ~*word + 1;  // -x holds the lowest bit that x does, and all above it
        ++word;
    }
    std::fill(word, end, ~Word{0});
}

// Notes for each of `runs` that it has reached `others`.
void extend(runtime::ScratchVector<RunRange>& reached, const RunRange& runs,
            const RunRange& others) noexcept {
    for (std::ptrdiff_t run = runs.first; run < runs.end; ++run) {
        RunRange& of_run = reached[static_cast<std::size_t>(run)];
        of_run.first = std::min(of_run.first, others.first);
        of_run.end = std::max(of_run.end, others.end);
    }
}

}  // namespace

ReachFront::ReachFront(const PointArray& P, std::ptrdiff_t n, const PointArray& Q, std::ptrdiff_t m,
                       std::ptrdiff_t dim, double threshold, kernels::ReachFunction reach,
                       ReachedRuns* reached)
    : P_(P),
      Q_(Q),
      n_(n),
      m_(m),
      reach_(reach),
      reached_(reached),
      p_(static_cast<std::size_t>(runs_of(n)), 0),
      q_(static_cast<std::size_t>(runs_of(m)), 0) {
    block_.across_stride = P.stride;
    block_.down_stride = Q.stride;
    block_.down_step = Q.step;
    block_.dim = dim;
    block_.threshold = threshold;
    if (reached_ != nullptr) {
        reached_->of_p.assign(p_.size(), {runs_of(m), 0});
        reached_->of_q.assign(q_.size(), {runs_of(n), 0});
    }
}

bool ReachFront::is_entered(const RunRange& p, const RunRange& q, bool corner) const noexcept {
    return corner || any(p_.data(), p) || any(q_.data(), q);
}

void ReachFront::block(const RunRange& p, const RunRange& q) noexcept {
    std::fill(p_.data() + p.first, p_.data() + p.end, 0);
    std::fill(q_.data() + q.first, q_.data() + q.end, 0);
}

// Every cell behind a cell that is reached can be reached from it.
void ReachFront::pass(const RunRange& p, const RunRange& q, bool corner) noexcept {
    const bool p_is_entered = any(p_.data(), p);
    flood(p_.data(), p, corner || any(q_.data(), q));
    flood(q_.data(), q, corner || p_is_entered);
    if (reached_ != nullptr) note_reached(p, q);
}

void ReachFront::note_reached(const RunRange& p, const RunRange& q) noexcept {
    extend(reached_->of_p, p, q);
    extend(reached_->of_q, q, p);
}

std::int64_t ReachFront::sweep(std::ptrdiff_t p_run, std::ptrdiff_t q_run, bool corner) noexcept {
    const std::ptrdiff_t i = p_run * kernels::block_side, j = q_run * kernels::block_side;
    Word& above = p_[static_cast<std::size_t>(p_run)];
    Word& beside = q_[static_cast<std::size_t>(q_run)];
    block_.across = P_.data + i;
    block_.down = Q_.data + j * Q_.step;
    block_.columns = std::min(kernels::block_side, n_ - i);
    block_.rows = std::min(kernels::block_side, m_ - j);
    block_.above = above;
    block_.beside = beside;
    block_.corner = corner;
    reach_(block_);
    if (reached_ != nullptr && block_.is_reached) {
        note_reached({p_run, p_run + 1}, {q_run, q_run + 1});
    }
    above = block_.above;
    beside = block_.beside;
    return block_.columns * block_.rows;
}

}  // namespace curvewise::warping
