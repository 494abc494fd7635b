#include "nearest/index_view.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace curvewise::nearest {
namespace {

[[noreturn]] void refuse(std::size_t place, std::int64_t index, const std::string& why) {
    throw std::invalid_argument("indices[" + std::to_string(place) + "] is " +
                                std::to_string(index) + why);
}

}  // namespace

TargetIndices::TargetIndices(std::vector<std::int64_t> first, std::int64_t next)
    : first_(std::move(first)), next_(next) {
    std::int64_t least = 0;
    for (std::size_t k = 0; k < first_.size(); ++k) {
        if (first_[k] < least || first_[k] >= next) {
            refuse(k, first_[k],
                   "; give indices in ascending order from 0 to below next_index, " +
                       std::to_string(next));
        }
        least = first_[k] + 1;
    }
}

std::int64_t TargetIndices::operator[](std::ptrdiff_t target) const noexcept {
    const auto size = static_cast<std::ptrdiff_t>(first_.size());
    return target < size ? first_[static_cast<std::size_t>(target)] : next_ + (target - size);
}

std::ptrdiff_t TargetIndices::target(std::int64_t index) const noexcept {
    const auto size = static_cast<std::ptrdiff_t>(first_.size());
    if (index >= next_) return size + static_cast<std::ptrdiff_t>(index - next_);
    const auto place = std::lower_bound(first_.begin(), first_.end(), index);
    return place != first_.end() && *place == index ? place - first_.begin() : -1;
}

std::vector<std::ptrdiff_t> IndexView::targets() const {
    std::vector<std::ptrdiff_t> all;
    all.reserve(static_cast<std::size_t>(seen.remaining));
    for (std::ptrdiff_t j = 0; j < seen.size; ++j) {
        if (seen.has(j)) all.push_back(j);
    }
    return all;
}

std::shared_ptr<const IndexView::Sizes> SizeCounts::with(
    const Counts& more, std::shared_ptr<const IndexView::Sizes> sizes) {
    IndexView::Sizes others;
    for (const auto& [size, count] : more) {
        counts_.try_emplace(size, 0);
        if (sizes->count(size) == 0) others.insert(size);
    }
    if (others.empty()) return sizes;
    others.insert(sizes->begin(), sizes->end());
    return std::make_shared<const IndexView::Sizes>(std::move(others));
}

std::shared_ptr<const IndexView::Sizes> SizeCounts::without(
    const Counts& fewer, std::shared_ptr<const IndexView::Sizes> sizes) const {
    IndexView::Sizes vanished;
    for (const auto& [size, count] : fewer) {
        if (counts_.at(size) == count) vanished.insert(size);
    }
    if (vanished.empty()) return sizes;
    IndexView::Sizes others;
    for (const std::ptrdiff_t size : *sizes) {
        if (vanished.count(size) == 0) others.insert(size);
    }
    return std::make_shared<const IndexView::Sizes>(std::move(others));
}

void SizeCounts::add(const Counts& more) noexcept {
    for (const auto& [size, count] : more) counts_.find(size)->second += count;
}

void SizeCounts::remove(const Counts& fewer) noexcept {
    for (const auto& [size, count] : fewer) counts_.find(size)->second -= count;
}

IndexView without(const IndexView& view, const std::vector<std::int64_t>& indices,
                  const TargetIndices& all, const pairwise::Targets& targets,
                  SizeCounts::Counts& fewer) {
    const pairwise::Seen& seen = view.seen;
    const std::int64_t end = all[seen.size];
    auto removed = std::make_shared<std::vector<bool>>();
    if (seen.removed != nullptr) *removed = *seen.removed;
    removed->resize(static_cast<std::size_t>(seen.size));
    IndexView next = view;
    for (std::size_t k = 0; k < indices.size(); ++k) {
        if (end == 0) refuse(k, indices[k], "; the index has no curves");
        if (indices[k] < 0 || indices[k] >= end) {
            refuse(k, indices[k],
                   "; give indices of curves of the index, from 0 to " + std::to_string(end - 1));
        }
        const std::ptrdiff_t j = all.target(indices[k]);
        if (j < 0 || !seen.has(j)) {
            refuse(k, indices[k], ", which was removed before; give indices of curves that remain");
        }
        const auto place = static_cast<std::size_t>(j);
        if ((*removed)[place]) refuse(k, indices[k], " again; give each index once");
        (*removed)[place] = true;
        const std::ptrdiff_t points = targets.curve(j).curve.size();
        ++fewer[points];
        --next.seen.remaining;
        next.seen.points -= points;
    }
    next.seen.removed = std::move(removed);
    return next;
}

}  // namespace curvewise::nearest
