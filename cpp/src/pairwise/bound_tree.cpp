#include "pairwise/bound_tree.hpp"

namespace curvewise::pairwise {
namespace {

std::ptrdiff_t quotient_up(std::ptrdiff_t a, std::ptrdiff_t b) noexcept { return (a + b - 1) / b; }

// The rows of a tree while they are divided.
class Division {
   public:
    Division(const BoundRows& rows, std::ptrdiff_t first, std::ptrdiff_t count, Poller& poller)
        : width_(rows.shape.width),
          dividing_(rows.shape.dividing),
          poller_(poller),
          numbers_(static_cast<std::size_t>(count * width_)) {
        entries_.reserve(static_cast<std::size_t>(count));
        for (std::ptrdiff_t k = 0; k < count; ++k) {
            poller.spend(width_);
            rows.write(first + k, numbers_.data() + k * width_);
            entries_.push_back({0.0, static_cast<std::uint32_t>(k)});
        }
    }

    // Orders the rows so that every `block` of them is a box, and divides these further.
    void divide(std::ptrdiff_t block) { divide(entries_.data(), size(), block); }

    std::ptrdiff_t size() const noexcept { return static_cast<std::ptrdiff_t>(entries_.size()); }
    std::uint32_t place(std::ptrdiff_t k) const noexcept {
        return entries_[static_cast<std::size_t>(k)].place;
    }
    const double* row(std::uint32_t place) const noexcept {
        return numbers_.data() + static_cast<std::ptrdiff_t>(place) * width_;
    }

   private:
    struct Entry {
        double number;
        std::uint32_t place;
    };

    void divide(Entry* first, std::ptrdiff_t count, std::ptrdiff_t block) {
        while (count <= block) {
            if (block == BoundTree::leaf_rows) return;
            block /= BoundTree::fan;
        }
        const std::ptrdiff_t half = quotient_up(count, block) / 2 * block;
        poller_.spend(count);
        const std::ptrdiff_t c = most_different(first, count);
        for (std::ptrdiff_t k = 0; k < count; ++k) first[k].number = row(first[k].place)[c];
        std::nth_element(first, first + half, first + count,
                         [](const Entry& a, const Entry& b) { return a.number < b.number; });
        divide(first, half, block);
        divide(first + half, count - half, block);
    }

    // Among about 32 of the rows.
    std::ptrdiff_t most_different(const Entry* entries, std::ptrdiff_t count) const noexcept {
        const std::ptrdiff_t step = quotient_up(count, 32);
        std::ptrdiff_t most = 0;
        double largest = -1.0;
        for (std::ptrdiff_t c = 0; c < dividing_; ++c) {
            double low = row(entries[0].place)[c], high = low;
            for (std::ptrdiff_t k = step; k < count; k += step) {
                const double number = row(entries[k].place)[c];
                low = std::min(low, number);
                high = std::max(high, number);
            }
            if (high - low > largest) {
                largest = high - low;
                most = c;
            }
        }
        return most;
    }

    std::ptrdiff_t width_;
    std::ptrdiff_t dividing_;
    Poller& poller_;
    std::vector<double> numbers_;
    std::vector<Entry> entries_;
};

// Makes the box at `box` around itself and another, whose greatest numbers are at `greatest`.
void enclose(double* box, const double* least, const double* greatest,
             std::ptrdiff_t width) noexcept {
    for (std::ptrdiff_t c = 0; c < width; ++c) {
        box[c] = std::min(box[c], least[c]);
        box[width + c] = std::max(box[width + c], greatest[c]);
    }
}

}  // namespace

BoundTree::BoundTree(const BoundRows& rows, std::ptrdiff_t first, std::ptrdiff_t count,
                     Poller& poller)
    : width_(rows.shape.width), first_box_{0, quotient_up(count, leaf_rows)} {
    std::ptrdiff_t block = leaf_rows;
    for (; boxes(levels() - 1) > fan; block *= fan) {
        first_box_.push_back(first_box_.back() + quotient_up(boxes(levels() - 1), fan));
    }
    Division division(rows, first, count, poller);
    division.divide(block);
    places_.reserve(static_cast<std::size_t>(count));
    for (std::ptrdiff_t k = 0; k < count; ++k) places_.push_back(division.place(k));
    numbers_.resize(static_cast<std::size_t>(first_box_.back() * 2 * width_));
    double* box = numbers_.data();
    for (std::ptrdiff_t b = 0; b < boxes(0); ++b, box += 2 * width_) {
        const Leaf held = leaf(b);
        std::copy_n(division.row(held.places[0]), width_, box);
        std::copy_n(box, width_, box + width_);
        for (std::ptrdiff_t k = 1; k < held.count; ++k) {
            const double* const row = division.row(held.places[k]);
            enclose(box, row, row, width_);
        }
    }
    for (int level = 1; level < levels(); ++level) {
        for (std::ptrdiff_t b = 0; b < boxes(level); ++b, box += 2 * width_) {
            std::copy_n(this->box(level - 1, b * fan), 2 * width_, box);
            const std::ptrdiff_t end = std::min((b + 1) * fan, boxes(level - 1));
            for (std::ptrdiff_t below = b * fan + 1; below < end; ++below) {
                const double* const held = this->box(level - 1, below);
                enclose(box, held, held + width_, width_);
            }
        }
    }
}

BoundForest BoundForest::with(std::ptrdiff_t own_size, const BoundForest& others,
                              std::ptrdiff_t size, const BoundRows& rows, Poller& poller) const {
    struct Part {
        std::ptrdiff_t first, count;
        std::shared_ptr<const BoundTree> tree;  // null where it is to be made
    };
    std::vector<Part> parts;
    for (const Planted& own : trees_) parts.push_back({own.first, own.tree->size(), own.tree});
    if (!others.trees().empty() && size_ < own_size) {
        parts.push_back({size_, own_size - size_, nullptr});
    }
    for (const Planted& other : others.trees()) {
        parts.push_back({own_size + other.first, other.tree->size(), other.tree});
    }
    if (rows.shape.width == 0) return {};
    const std::ptrdiff_t planted = parts.empty() ? 0 : parts.back().first + parts.back().count;
    if (size - planted >= fewest_rows) parts.push_back({planted, size - planted, nullptr});
    while (parts.size() > 1) {
        Part& before = parts[parts.size() - 2];
        const std::ptrdiff_t count = parts.back().count;
        if (before.count > count || before.count + count > most_merged_rows) break;
        before = {before.first, before.count + count, nullptr};
        parts.pop_back();
    }
    BoundForest forest;
    for (Part& part : parts) {
        if (part.tree == nullptr) {
            part.tree = std::make_shared<const BoundTree>(rows, part.first, part.count, poller);
        }
        forest.trees_.push_back({part.first, std::move(part.tree)});
        forest.size_ = part.first + part.count;
    }
    return forest;
}

}  // namespace curvewise::pairwise
