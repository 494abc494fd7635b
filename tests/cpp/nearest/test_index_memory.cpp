// The heap memory of an index with all its curves, compared with the points of the curves. Each
// allocation is counted with malloc's overhead.
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "check.hpp"
#include "curvewise/curvewise.hpp"
#include "runtime/scratch.hpp"

namespace {

std::size_t held = 0;

// In front of a block: its size, in as many bytes as keep it aligned.
constexpr std::size_t head = alignof(std::max_align_t);

std::size_t taken(std::size_t size) { return (size + 8 + 15) / 16 * 16; }

}  // namespace

void* operator new(std::size_t size) {
    auto* const block = static_cast<std::byte*>(std::malloc(size + head));
    if (block == nullptr) throw std::bad_alloc();
    *reinterpret_cast<std::size_t*>(block) = size;
    held += taken(size);
    return block + head;
}

void operator delete(void* data) noexcept {
    if (data == nullptr) return;
    // Hidden from gcc, which mistakes it for the caller's array and warns of the bytes in front of
    // it.
    void* volatile given = data;
    std::byte* const block = static_cast<std::byte*>(given) - head;
    held -= taken(*reinterpret_cast<std::size_t*>(block));
    std::free(block);
}
void operator delete(void* data, std::size_t /*size*/) noexcept { operator delete(data); }

namespace {

using namespace curvewise;

struct Collection {
    std::ptrdiff_t curves, points, dim;
};

// In ratio to the points.
double memory_of(const Measure& measure, const Collection& size) {
    const std::ptrdiff_t numbers = size.points * size.dim;
    std::vector<double> points(static_cast<std::size_t>(size.curves * numbers));
    for (std::size_t k = 0; k < points.size(); ++k) points[k] = static_cast<double>(k * k % 1009);
    std::vector<CurveView> views;
    for (std::ptrdiff_t j = 0; j < size.curves; ++j) {
        views.emplace_back(points.data() + j * numbers, size.points, size.dim);
    }
    runtime::release_scratch();  // neither memory of earlier calls, nor of this one
    const std::size_t before = held;
    const Index index(views, measure);
    runtime::release_scratch();
    return static_cast<double>(held - before) / static_cast<double>(points.size() * sizeof(double));
}

void index_is_little_more_than_its_points() {
    struct Limit {
        const char* name;
        Measure measure;
        double ratio;
    };
    const Limit limits[] = {{"dtw", DtwOptions{}, 1.3},
                            {"frechet", FrechetOptions{}, 1.3},
                            {"hausdorff", HausdorffOptions{}, 1.1},
                            {"area", AreaOptions{}, 1.1},
                            {"frechet_continuous", FrechetContinuousOptions{}, 2.1}};
    for (const Limit& limit : limits) {
        for (const Collection& size :
             {Collection{1000, 128, 1}, {1000, 128, 2}, {100, 1000, 1}, {100, 1000, 2}}) {
            if (size.dim == 1 && std::string(limit.name) == "area") continue;
            const check::Note note(std::string(limit.name) + " of " + std::to_string(size.points) +
                                   " points in " + std::to_string(size.dim) + "-D");
            const double ratio = memory_of(limit.measure, size);
            CHECK(ratio >= 1.0);
            CHECK(ratio <= limit.ratio);
        }
    }
}

// What is kept besides the points weighs most there.
void index_of_short_curves_is_not_much_more() {
    struct Limit {
        Collection size;
        double of_bounds, of_none;
    };
    const Limit limits[] = {{{10000, 16, 1}, 1.9, 1.3},
                            {{10000, 32, 1}, 1.6, 1.2},
                            {{10000, 16, 2}, 1.6, 1.2},
                            {{10000, 64, 1}, 1.4, 1.1},
                            {{10000, 32, 2}, 1.4, 1.1}};
    for (const Limit& limit : limits) {
        const check::Note note(std::to_string(limit.size.points) + " points in " +
                               std::to_string(limit.size.dim) + "-D");
        CHECK(memory_of(DtwOptions{}, limit.size) <= limit.of_bounds);
        CHECK(memory_of(FrechetOptions{}, limit.size) <= limit.of_bounds);
        CHECK(memory_of(HausdorffOptions{}, limit.size) <= limit.of_none);
    }
}

}  // namespace

int main() {
    return check::run(
        {{"an index is little more than its points", index_is_little_more_than_its_points},
         {"an index of short curves is not much more", index_of_short_curves_is_not_much_more}});
}
