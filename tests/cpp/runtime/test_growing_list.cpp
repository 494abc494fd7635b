// Lists whose elements stay where they are.
#include <cstddef>
#include <memory>
#include <vector>

#include "check.hpp"
#include "runtime/growing_list.hpp"

namespace {

using curvewise::runtime::GrowingList;
using curvewise::runtime::GrowingRuns;

int alive = 0;

// Owns memory, so that a sanitizer sees what is lost or destroyed twice.
class Element {
   public:
    explicit Element(std::ptrdiff_t value) : value_(std::make_unique<std::ptrdiff_t>(value)) {
        ++alive;
    }
    Element(Element&& other) noexcept : value_(std::move(other.value_)) { ++alive; }
    Element(const Element&) = delete;
    Element& operator=(const Element&) = delete;
    Element& operator=(Element&&) = delete;
    ~Element() { --alive; }
    std::ptrdiff_t value() const noexcept { return *value_; }

   private:
    std::unique_ptr<std::ptrdiff_t> value_;
};

void push(GrowingList<Element>& list, std::ptrdiff_t count, std::ptrdiff_t& next) {
    for (; count > 0; --count) list.push_back(Element(next++));
}

void check_elements(const GrowingList<Element>& list, std::ptrdiff_t size) {
    CHECK_EQUAL(list.size(), size);
    CHECK_EQUAL(alive, static_cast<int>(size));
    for (std::ptrdiff_t i = 0; i < size; ++i) CHECK_EQUAL(list[i].value(), i);
    for (const std::ptrdiff_t first : {std::ptrdiff_t{0}, size / 4, size / 2, size}) {
        for (const std::ptrdiff_t end : {first, (first + size) / 2, size}) {
            std::ptrdiff_t i = first;
            list.in_parts(first, end - first, [&](const Element* elements, std::ptrdiff_t part) {
                CHECK(part > 0);
                for (std::ptrdiff_t k = 0; k < part; ++k) CHECK_EQUAL(elements[k].value(), i++);
            });
            CHECK_EQUAL(i, end);
        }
    }
}

void elements_stay_where_they_are() {
    {
        GrowingList<Element> list;
        std::ptrdiff_t next = 0;
        std::vector<const Element*> places;
        for (const std::ptrdiff_t more : {5, 1, 1, 0, 40, 3, 1, 100, 1}) {
            if (more % 2 == 0) list.make_room(more + 2);  // more than is then needed
            GrowingList<Element> added;
            added.make_room(more / 2);
            push(added, more, next);
            list.make_room(added);
            list.make_room(added);  // as after the failure of another list
            list.take(added);
            CHECK_EQUAL(added.size(), 0);
            push(added, 2, next);  // it can be used again
            list.make_room(added);
            list.take(added);
            push(list, 1, next);
            check_elements(list, next);
            for (std::size_t i = 0; i < places.size(); ++i) {
                CHECK(&list[static_cast<std::ptrdiff_t>(i)] == places[i]);
            }
            places.clear();
            for (std::ptrdiff_t i = 0; i < next; ++i) places.push_back(&list[i]);
        }
    }
    CHECK_EQUAL(alive, 0);
}

// Each block doubles the list, however small the steps are.
void blocks_are_few() {
    GrowingList<int> list;
    for (int i = 0; i < 100000; ++i) list.push_back(i);
    int parts = 0;
    list.in_parts(0, 100000, [&](const int*, std::ptrdiff_t) { ++parts; });
    CHECK(parts <= 18);
    CHECK_EQUAL(list[99999], 99999);
}

void runs_are_consecutive_and_stay() {
    GrowingRuns<double> runs;
    std::vector<const double*> places;
    std::vector<std::ptrdiff_t> sizes;
    const auto write = [&](std::ptrdiff_t size) {
        runs.make_room(size);
        double* const run = runs.append(size);
        for (std::ptrdiff_t k = 0; k < size; ++k) run[k] = static_cast<double>(100 * size + k);
        places.push_back(run);
        sizes.push_back(size);
    };
    std::ptrdiff_t total = 0;
    for (const std::ptrdiff_t size : {3, 1, 7, 2, 50, 4, 1, 1, 20}) {
        write(size);
        total += size;
        CHECK_EQUAL(runs.size(), total);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::ptrdiff_t k = 0; k < sizes[i]; ++k) {
            CHECK_EQUAL(places[i][k], static_cast<double>(100 * sizes[i] + k));
        }
    }
}

}  // namespace

int main() {
    return check::run({{"elements stay where they are", elements_stay_where_they_are},
                       {"blocks are few", blocks_are_few},
                       {"runs are consecutive and stay", runs_are_consecutive_and_stay}});
}
