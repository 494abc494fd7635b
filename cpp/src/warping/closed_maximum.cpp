#include "warping/closed_maximum.hpp"

#include <algorithm>

#include "curvewise/control.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::warping {

double LeastMaximumSearch::run(double most) {
    double low = lower_bound(), high = greedy();
    if (high > most) {
        if (!admits(most)) return infinity;
        high = used_;
    }
    while (low < high) {
        const double middle = low + 0.5 * (high - low);
        if (admits(middle)) {
            high = used_;
        } else {
            low = blocked_;
        }
    }
    return high;
}

double LeastMaximumSearch::lower_bound() {
    constexpr std::ptrdiff_t looks = 32;
    double bound = 0.0;
    for (std::ptrdiff_t i = 0; i < n_; i += std::max<std::ptrdiff_t>(1, n_ / looks)) {
        distances_.compute(i, 0, m_ - 1);
        double nearest = infinity;
        for (std::ptrdiff_t j = 0; j < m_; ++j) nearest = std::min(nearest, distances_[j]);
        bound = std::max(bound, nearest);
        if (poller_.count_steps(m_)) throw Stopped();
    }
    return bound;
}

double LeastMaximumSearch::greedy() {
    distances_.compute(0, 0, m_ - 1);
    std::ptrdiff_t j = 0;
    for (std::ptrdiff_t k = 1; k < m_; ++k) {
        if (distances_[k] < distances_[j]) j = k;
    }
    double value = distances_[j];
    const std::ptrdiff_t end = j + m_;
    for (std::ptrdiff_t i = 0; i < n_ || j < end;) {
        const bool can_rise = i < n_, can_go = j < end;
        double beside = infinity, above = infinity, across = infinity;
        if (can_go) {
            distances_.compute(i, j, j + 1);
            beside = distances_[j + 1];
        }
        if (can_rise) {
            distances_.compute(i + 1, j, can_go ? j + 1 : j);
            above = distances_[j];
            if (can_go) across = distances_[j + 1];
        }
        const double least = std::min(across, std::min(above, beside));
        const bool is_across = can_rise && can_go && across <= least;
        const bool is_above = can_rise && !is_across && (above <= least || !can_go);
        if (is_across || is_above) ++i;
        if (!is_above) ++j;
        value = std::max(value, least);
        poller_.spend(3);
    }
    return value;
}

bool LeastMaximumSearch::admits(double bound) {
    used_ = 0.0;
    blocked_ = infinity;
    for (std::ptrdiff_t i = 0; i <= n_; ++i) {
        if (!reach_row(i, bound)) return false;
    }
    runtime::ScratchVector<std::ptrdiff_t> candidates;
    const Range last = live_.back();
    for (std::ptrdiff_t j = std::max(last.first, m_); j <= std::min(last.last, 2 * m_ - 1); ++j) {
        const Starts& starts = row_[static_cast<std::size_t>(j)];
        const std::ptrdiff_t k = j - m_;
        if (starts.are_there() && starts.first <= k && k <= starts.last) candidates.push_back(k);
    }
    if (candidates.empty()) return false;
    // From which cells of the first row the last one is reached, in the same way backwards.
    for (std::ptrdiff_t i = n_; i >= 0; --i) reach_back(i, bound);
    for (const std::ptrdiff_t k : candidates) {
        if (k < live_.front().first || !row_[static_cast<std::size_t>(k)].are_there()) continue;
        start_ = k;
        return true;
    }
    return false;
}

bool LeastMaximumSearch::reach_row(std::ptrdiff_t i, double bound) {
    std::swap(row_, above_);
    constexpr Starts none{-1, -1};
    const Range before = i == 0 ? Range{0, m_ - 2} : live_[static_cast<std::size_t>(i - 1)];
    Range live{2 * m_ + 1, -1};
    std::ptrdiff_t known = before.first - 1, j = before.first;
    Starts left = none;
    for (; j <= 2 * m_; ++j) {
        if (j > before.last + 1 && !left.are_there()) break;
        if (j > known) {
            known = std::min(2 * m_, std::max(before.last + 1, j + chunk));
            distances_.compute(i, j, known);
        }
        Starts starts = left;
        if (i == 0 && j < m_) {
            starts.add({j, j});
        } else if (i > 0) {
            if (j <= before.last) starts.add(above_[static_cast<std::size_t>(j)]);
            if (j > before.first && j <= before.last + 1) {
                starts.add(above_[static_cast<std::size_t>(j - 1)]);
            }
        }
        const double distance = distances_[j];
        if (starts.are_there() && distance > bound) {
            blocked_ = std::min(blocked_, distance);
            starts = none;
        } else if (starts.are_there()) {
            used_ = std::max(used_, distance);
            live = {std::min(live.first, j), j};
        }
        row_[static_cast<std::size_t>(j)] = left = starts;
    }
    live_[static_cast<std::size_t>(i)] = live;
    if (poller_.count_steps(j - before.first)) throw Stopped();
    return live.last >= 0;
}

void LeastMaximumSearch::reach_back(std::ptrdiff_t i, double bound) {
    std::swap(row_, above_);
    const Range live = live_[static_cast<std::size_t>(i)];
    const Range next = i == n_ ? Range{1, 0} : live_[static_cast<std::size_t>(i + 1)];
    const auto reaches = [&](std::ptrdiff_t j) {
        return j >= next.first && j <= next.last && above_[static_cast<std::size_t>(j)].are_there();
    };
    distances_.compute(i, live.first, live.last);
    bool right = i == n_;
    for (std::ptrdiff_t j = live.last; j >= live.first; --j) {
        right = distances_[j] <= bound && (i == n_ || right || reaches(j) || reaches(j + 1));
        row_[static_cast<std::size_t>(j)] = right ? Starts{0, 0} : Starts{-1, -1};
    }
    if (poller_.count_steps(live.last - live.first + 1)) throw Stopped();
}

}  // namespace curvewise::warping
