#include "nearest/block_search.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "nearest/own_count.hpp"

namespace curvewise::nearest {
namespace {

constexpr double no_bound = -std::numeric_limits<double>::infinity();

// Of many targets, fewer are candidates. The distances from some of them then give a cutoff for the
// others.
constexpr std::ptrdiff_t many_columns = 512;
constexpr std::ptrdiff_t first_columns = 128;

// About this number of queries of a block shows whether bounds pay for the others. They lie apart,
// because queries are often ordered by class.
constexpr std::size_t tested_queries = 4;

// What raising a bound takes, for the poller: a microsecond.
constexpr std::int64_t effort_to_raise = 1 << 10;

}  // namespace

BlockSearch::BlockSearch(const pairwise::Targets& all, const std::vector<std::ptrdiff_t>& targets,
                         const BlockSize& size, runtime::Poller& poller)
    : all_(all),
      targets_(targets),
      lanes_(size.lanes),
      effort_(size.effort),
      poller_(poller),
      block_(all.make_block()),
      columns_(std::min(targets.size(), static_cast<std::size_t>(most_columns))),
      rows_(static_cast<std::size_t>(most_queries)),
      values_(static_cast<std::size_t>(size.lanes)) {
    std::iota(columns_.begin(), columns_.end(), std::ptrdiff_t{0});
}

void BlockSearch::answer(const BlockQuery* queries, std::ptrdiff_t count,
                         const Question& question) {
    const OwnCount own_count(poller_);
    const auto all = static_cast<std::ptrdiff_t>(targets_.size());
    const curves::CheckedCurve* curves[most_queries];
    const auto size = static_cast<std::size_t>(count);
    for (std::size_t i = 0; i < size; ++i) {
        curves[i] = rows_[i].curve = queries[i].curve;
        rows_[i].found.begin(question);
        rows_[i].left_out = queries[i].left_out;
        record_.pairs += all - count_left_out(queries[i].left_out);
        rows_[i].query = nullptr;
        rows_[i].taken.clear();
    }
    block_->set_rows(curves, count, poller_);
    question_ = question;
    has_bounds_ = effort_.most_candidates() > (all >= many_columns ? 0.1 : 0.25) && trial_.is_due();
    const bool is_test = has_bounds_ && !have_paid_ && size > tested_queries;
    const std::size_t step = is_test ? size / tested_queries : 1;
    rows_now_.clear();
    for (std::size_t i = 0; i < size; i += step) rows_now_.push_back(i);
    answer_rows();
    if (!is_test) return;
    has_bounds_ = have_paid_;
    rows_now_.clear();
    for (std::size_t i = 0; i < size; ++i) {
        if (i % step != 0) rows_now_.push_back(i);
    }
    answer_rows();
}

void BlockSearch::answer_rows() {
    const auto all = static_cast<std::ptrdiff_t>(targets_.size());
    for (std::ptrdiff_t first = 0; first < all; first += most_columns) {
        look_at_part(first, std::min(most_columns, all - first));
    }
    if (!has_bounds_) return;
    const double pairs = static_cast<double>(rows_now_.size()) * static_cast<double>(all);
    std::ptrdiff_t near = 0;
    for (const std::size_t i : rows_now_) near += rows_[i].count_near();
    have_paid_ = static_cast<double>(near) <= effort_.most_candidates() * pairs;
    trial_.record(have_paid_);
}

std::ptrdiff_t BlockSearch::count_left_out(LeftOut left_out) const noexcept {
    const auto first = std::lower_bound(targets_.begin(), targets_.end(), left_out.first);
    return std::upper_bound(first, targets_.end(), left_out.last) - first;
}

void BlockSearch::look_at_part(std::ptrdiff_t first, std::ptrdiff_t count) {
    if (first_ != first) block_->set_columns(targets_.data() + first, count);
    first_ = first;
    raises_bounds_ = has_bounds_ && effort_.is_large;
    const std::ptrdiff_t few =
        first == 0 && count >= many_columns && !raises_bounds_ ? first_columns : count;
    look_at_columns(0, few);
    if (few < count) look_at_columns(few, count);
}

void BlockSearch::look_at_columns(std::ptrdiff_t column, std::ptrdiff_t end) {
    for (const std::size_t i : rows_now_) {
        rows_[i].candidates.clear();
        rows_[i].next = 0;
    }
    while (column < end) {
        const std::ptrdiff_t taken =
            block_->gather(columns_.data() + column, std::min(lanes_, end - column));
        if (taken > 0) {
            for (const std::size_t i : rows_now_) look_at_row(i, column, taken);
            column += taken;
        } else {
            for (const std::size_t i : rows_now_) add(rows_[i], column, no_bound);
            ++column;
        }
    }
    take_turns();
}

void BlockSearch::look_at_row(std::size_t i, std::ptrdiff_t first, std::ptrdiff_t count) {
    Row& row = rows_[i];
    const auto number = static_cast<std::ptrdiff_t>(i);
    double* const values = values_.data();
    if (has_bounds_ && block_->bounds(number, row.found.cutoff(), values, poller_)) {
        record_.refined += count;
        for (std::ptrdiff_t k = 0; k < count; ++k) add(row, first + k, values[k]);
    } else if (block_->values(number, values, poller_)) {
        record_.computed += count;
        keep_all(row, first, count);
    } else {
        for (std::ptrdiff_t k = 0; k < count; ++k) add(row, first + k, no_bound);
    }
}

void BlockSearch::keep_all(Row& row, std::ptrdiff_t first, std::ptrdiff_t count) {
    const double* const values = values_.data();
    double cutoff = row.found.cutoff();
    bool has_near = false;  // found without branches
    for (std::ptrdiff_t k = 0; k < count; ++k) has_near |= !(values[k] > cutoff);
    if (!has_near) return;
    for (std::ptrdiff_t k = 0; k < count; ++k) {
        if (values[k] > cutoff) continue;
        keep(row, first + k, values[k]);
        cutoff = row.found.cutoff();
    }
}

void BlockSearch::add(Row& row, std::ptrdiff_t column, double bound) {
    if (bound > row.found.cutoff() || is_left_out(row, column)) return;
    row.candidates.push_back({bound, static_cast<std::int32_t>(column), false});
}

void BlockSearch::keep(Row& row, std::ptrdiff_t column, double distance) {
    if (!is_left_out(row, column)) {
        row.found.keep({target(column), distance});
    }
}

void BlockSearch::take_turns() {
    for (const std::size_t i : rows_now_) order(rows_[i]);
    for (bool is_finished = false; !is_finished;) {
        is_finished = true;
        for (const std::size_t i : rows_now_) {
            const bool is_taken = raises_bounds_ ? take_nearest(i) : take_next(i);
            is_finished = is_finished && !is_taken;
            if (static_cast<std::ptrdiff_t>(pairs_.size()) == lanes_) compute_pairs();
        }
    }
    if (!pairs_.empty()) compute_pairs();
}

// All for a heap, or the first ones alone, which then give the cutoff.
void BlockSearch::order(Row& row) const {
    auto& candidates = row.candidates;
    if (raises_bounds_) {
        return std::make_heap(candidates.begin(), candidates.end(), ComesLater());
    }
    const std::ptrdiff_t first =
        std::min(question_.count, static_cast<std::ptrdiff_t>(candidates.size()));
    const auto comes_first = [](const Candidate& a, const Candidate& b) {
        return ComesLater()(b, a);
    };
    if (first == 0) return;  // the cutoff is given
    if (first == 1) {
        std::iter_swap(candidates.begin(),
                       std::min_element(candidates.begin(), candidates.end(), comes_first));
    } else {
        std::nth_element(candidates.begin(), candidates.begin() + first, candidates.end(),
                         comes_first);
    }
}

bool BlockSearch::take_next(std::size_t i) {
    Row& row = rows_[i];
    const double cutoff = row.found.cutoff();
    while (row.next < row.candidates.size() && row.candidates[row.next].bound > cutoff) ++row.next;
    if (row.next == row.candidates.size()) return false;
    take(i, row.candidates[row.next++]);
    return true;
}

void BlockSearch::take(std::size_t i, const Candidate& candidate) {
    pairs_.emplace_back(static_cast<std::ptrdiff_t>(i), candidate.column);
    rows_[i].taken.push_back(candidate.bound);
}

bool BlockSearch::take_nearest(std::size_t i) {
    Row& row = rows_[i];
    auto& candidates = row.candidates;
    while (!candidates.empty() && !(candidates.front().bound > row.found.cutoff())) {
        std::pop_heap(candidates.begin(), candidates.end(), ComesLater());
        Candidate candidate = candidates.back();
        candidates.pop_back();
        if (!candidate.is_raised) {
            raise(row, candidate);
            if (candidate.bound > row.found.cutoff()) continue;
            if (!candidates.empty() && ComesLater()(candidate, candidates.front())) {
                candidates.push_back(candidate);
                std::push_heap(candidates.begin(), candidates.end(), ComesLater());
                continue;
            }
        }
        take(i, candidate);
        return true;
    }
    return false;
}

void BlockSearch::raise(Row& row, Candidate& candidate) {
    if (!row.query) row.query = all_.query(*row.curve, poller_);
    const double cutoff = row.found.cutoff();
    candidate.is_raised = true;
    for (int level = 1; level < row.query->levels() && !(candidate.bound > cutoff); ++level) {
        candidate.bound =
            std::max(candidate.bound, row.query->refined(target(candidate.column), level));
    }
    poller_.spend(effort_to_raise);
}

void BlockSearch::compute_pairs() {
    const auto count = static_cast<std::ptrdiff_t>(pairs_.size());
    record_.computed += count;
    const bool are_found = block_->pair_values(pairs_.data(), count, values_.data(), poller_);
    for (std::ptrdiff_t k = 0; k < count; ++k) {
        const auto [i, column] = pairs_[static_cast<std::size_t>(k)];
        Row& row = rows_[static_cast<std::size_t>(i)];
        const double distance = are_found ? values_[static_cast<std::size_t>(k)]
                                          : block_->value(i, column, row.found.cutoff(), poller_);
        keep(row, column, distance);
    }
    pairs_.clear();
    poller_.throw_if_stopped();
}

}  // namespace curvewise::nearest
