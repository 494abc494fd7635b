// A call allocates nothing after the first: the thread keeps the memory. A call that returns a
// container allocates that. Counted by the global operator new, and as living blocks, whose bytes
// are bounded and end with the thread.
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"
#include "runtime/scratch.hpp"

namespace {

std::atomic<std::int64_t> allocations{0};
std::atomic<std::int64_t> living{0};  // bytes

// In front of a block: its size, in as many bytes as keep it aligned.
constexpr std::size_t head = alignof(std::max_align_t);

}  // namespace

void* operator new(std::size_t size) {
    auto* const block = static_cast<std::byte*>(std::malloc(size + head));
    if (block == nullptr) throw std::bad_alloc();
    *reinterpret_cast<std::size_t*>(block) = size;
    ++allocations;
    living += static_cast<std::int64_t>(size);
    return block + head;
}
void operator delete(void* data) noexcept {
    if (data == nullptr) return;
    // Hidden from gcc, which mistakes it for the caller's array and warns of the bytes in front of
    // it.
    void* volatile given = data;
    std::byte* const block = static_cast<std::byte*>(given) - head;
    living -= static_cast<std::int64_t>(*reinterpret_cast<std::size_t*>(block));
    std::free(block);
}
void operator delete(void* data, std::size_t /*size*/) noexcept { operator delete(data); }

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;

constexpr std::int64_t most_kept = std::int64_t{1} << 22;

// How often the third such call allocates, where memory is kept.
void expect(const std::string& name, const std::function<void()>& call, std::int64_t expected = 0) {
    const check::Note note(name);
    call();
    call();
    const std::int64_t before = allocations;
    call();
    if (runtime::keeps_scratch) CHECK_EQUAL(allocations - before, expected);
}

// A recurrence is a public type, of vectors, that each single call makes from its options.
template <class Options>
constexpr bool makes_recurrence = is_edit_distance<Options>;

void pairs() {
    Random random(1);
    for (const std::ptrdiff_t n : {1, 5, 64, 300}) {
        for (const std::ptrdiff_t dim : {1, 2, 3}) {
            const Curve P = random.curve(n, dim), Q = random.curve(n - n / 8, dim);
            const check::Note note(std::to_string(n) + " points in " + std::to_string(dim) + "-D");
            for_each_measure([&](const auto& options) {
                using Options = std::decay_t<decltype(options)>;
                if ((Options::is_planar && dim != 2) || n < 5) return;
                if constexpr (!makes_recurrence<Options>) {
                    expect(options.measure, [&] { static_cast<void>(evaluate(options, P, Q)); });
                }
                const Prepared prepared(P, options);
                expect(std::string("Prepared ") + options.measure,
                       [&] { static_cast<void>(prepared(Q)); });
            });
            expect("dtw with Control", [&] {
                Control control;
                static_cast<void>(dtw(P, Q, {}, &control));
            });
        }
    }
}

void options_of_dtw() {
    Random random(2);
    const Curve P = random.walk(70), Q = random.walk(64);
    DtwOptions window, symmetric2, open, cutoff, whole;
    window.window_fraction = 0.1;
    symmetric2.step_pattern = StepPattern::symmetric2;
    symmetric2.normalize = true;
    open.open_begin = open.open_end = true;
    cutoff.cutoff = 0.5 * dtw(P, Q);
    whole.prune = false;
    for (const DtwOptions& options : {window, symmetric2, open, cutoff, whole}) {
        expect("dtw", [&] { static_cast<void>(dtw(P, Q, options)); });
    }
    for (std::size_t metric = 0; metric < choice_names(Metric{}).size(); ++metric) {
        DtwOptions dtw_options;
        FrechetOptions frechet_options;
        HausdorffOptions hausdorff_options;
        dtw_options.ground = frechet_options.ground =
            hausdorff_options.ground = {static_cast<Metric>(metric), 3.0};
        const check::Note note(choice_names(Metric{})[metric]);
        expect("dtw", [&] { static_cast<void>(dtw(P, Q, dtw_options)); });
        expect("frechet", [&] { static_cast<void>(frechet(P, Q, frechet_options)); });
        expect("hausdorff", [&] { static_cast<void>(hausdorff(P, Q, hausdorff_options)); });
    }
    const Curve large = P.times_power_of_two(800), small = P.times_power_of_two(-900);
    expect("dtw of large numbers", [&] { static_cast<void>(dtw(large, Q)); });
    expect("dtw of small numbers", [&] { static_cast<void>(dtw(small, small)); });
    expect("frechet_within", [&] { static_cast<void>(frechet_within(P, Q, 3.0)); });
}

void options_of_areas() {
    Random random(3);
    const Curve P = random.walk(70), Q = random.walk(64);
    for (const Spacing spacing : {Spacing::x, Spacing::arc_length}) {
        expect("area", [&] { static_cast<void>(area(P, Q, {spacing})); });
    }
    expect(
        "area, matched: the path of dtw_path",
        [&] { static_cast<void>(area(P, Q, {Spacing::matched})); }, 1);
    PcmOptions continuous;
    continuous.continuous = true;
    expect("pcm", [&] { static_cast<void>(pcm(P, Q, continuous)); });
}

// Curves like a program's own, short and of several lengths.
std::vector<Curve> templates(Random& random) {
    std::vector<Curve> curves;
    for (int k = 0; k < 64; ++k) curves.push_back(random.walk(32 + k));
    return curves;
}

void batches() {
    Random random(4);
    const std::vector<Curve> curves = templates(random);
    const std::vector<CurveView> X = test::views_of(curves), one{X[17]};
    std::vector<double> out(X.size() * X.size());
    for_each_measure([&](const auto& options) {
        using Options = std::decay_t<decltype(options)>;
        const check::Note note(options.measure);
        const Measure measure(options);
        // A recurrence and its steps, as for one pair.
        constexpr bool has_own_vectors = makes_recurrence<Options>;
        const Prepared prepared(X[17], measure);
        expect("Prepared, batch", [&] { prepared(X, out.data()); });
        if constexpr (!has_own_vectors) {
            expect("cdist", [&] { cdist(one, X, measure, out.data()); });
            expect("Prepared, made and asked", [&] {
                const Prepared own(X[17], measure);
                own(X, out.data());
            });
        }
    });
    expect("cdist of one list", [&] { cdist(X, DtwOptions{}, out.data()); });
    expect("pdist", [&] { pdist(X, FrechetOptions{}, out.data()); });
}

void results() {
    Random random(5);
    const Curve P = random.walk(50), Q = random.walk(64), stream = random.walk(1800);
    DtwOptions window;
    window.window_fraction = 0.1;
    expect(
        "dtw_path", [&] { static_cast<void>(dtw_path(P, Q)); }, 1);
    expect(
        "dtw_path in a window", [&] { static_cast<void>(dtw_path(P, Q, window)); }, 1);
    expect(
        "frechet_path", [&] { static_cast<void>(frechet_path(P, Q)); }, 1);
    expect(
        "subsequences", [&] { static_cast<void>(subsequences(P, stream)); }, 1);
}

void searches() {
    Random random(11);
    const std::vector<Curve> curves = templates(random);
    const std::vector<CurveView> X = test::views_of(curves), one{X[17]};
    std::vector<double> distances(3 * X.size());
    std::vector<std::int64_t> places(3 * X.size());
    for_each_measure([&](const auto& options) {
        const check::Note note(options.measure);
        const Index index(X, options);
        expect("kneighbors", [&] { index.kneighbors(one, 3, distances.data(), places.data()); });
        // The list of lists, and the list.
        expect(
            "radius_neighbors", [&] { static_cast<void>(index.radius_neighbors(one, 1e6)); }, 2);
    });
}

// A Report calls the function that reports: each has memory of its own.
void a_call_within_a_call() {
    Random random(6);
    const Curve P = random.walk(1500), Q = random.walk(1400);
    const double expected = dtw(P, Q), other = frechet(P, Q);
    int reports = 0;
    Control control(
        [&](std::int64_t, std::int64_t) {
            ++reports;
            CHECK_EQUAL(dtw(P, Q), expected);
            CHECK_EQUAL(frechet(P, Q), other);
            return true;
        },
        std::chrono::milliseconds(0));
    expect("dtw", [&] { CHECK_EQUAL(dtw(P, Q, {}, &control), expected); });
    CHECK(reports >= 6);
}

// What a call takes that is stopped, or fails, is given back, too.
void an_exception() {
    Random random(7);
    const Curve P = random.walk(1500), Q = random.walk(1400);
    const auto call = [&] {
        Control control([](std::int64_t, std::int64_t) { return false; },
                        std::chrono::milliseconds(0));
        CHECK_THROWS(dtw(P, Q, {}, &control), Stopped, "stopped before the work was done");
    };
    call();
    const std::int64_t before = living;
    for (int i = 0; i < 100; ++i) call();
    CHECK_EQUAL(living.load(), before);
}

void kept_memory_is_bounded() {
    Random random(8);
    runtime::release_scratch();
    const std::int64_t before = living;
    {
        const Curve P = random.walk(300'000), Q = random.walk(40);
        static_cast<void>(dtw(P, Q));
        std::vector<Curve> curves;
        for (int k = 0; k < 4000; ++k) curves.push_back(random.walk(100 + k % 50));
        const std::vector<CurveView> X = test::views_of(curves);
        std::vector<double> out(X.size());
        cdist({X[0]}, X, FrechetOptions{}, out.data());
        const Index index(X, FrechetOptions{});
    }
    CHECK(living - before <= most_kept);
    runtime::release_scratch();
    CHECK_EQUAL(living.load(), before);
}

void a_thread_ends_with_its_memory() {
    Random random(9);
    const Curve P = random.walk(200), Q = random.walk(190);
    const auto in_a_thread = [&] {
        std::thread([&] {
            for (int i = 0; i < 3; ++i) static_cast<void>(dtw(P, Q));
        }).join();
    };
    in_a_thread();
    const std::int64_t before = living;
    for (int i = 0; i < 20; ++i) in_a_thread();
    CHECK_EQUAL(living.load(), before);
}

// What one thread takes, another gives.
void a_prepared_curve_that_another_thread_ends() {
    Random random(10);
    const Curve P = random.walk(200), Q = random.walk(190);
    const double expected = dtw(P, Q);
    for (int i = 0; i < 20; ++i) {
        auto prepared = std::make_unique<Prepared>(P, DtwOptions{});
        std::thread([&] {
            CHECK_EQUAL((*prepared)(Q), expected);
            prepared.reset();
        }).join();
    }
}

// It ends after the objects of its thread that have the memory: its own is given back all the same.
struct Late {
    explicit Late(const Curve& P) : prepared(P, DtwOptions{}) {}
    Late(const Late&) = delete;
    Late(Late&&) = delete;
    Late& operator=(const Late&) = delete;
    Late& operator=(Late&&) = delete;
    ~Late() { sum += prepared(Curve({{0.0, 1.0}, {1.0, 2.0}})); }
    Prepared prepared;
    double sum = 0.0;
};

void objects_that_end_late() {
    const Curve P({{0.0, 0.0}, {1.0, 1.0}});
    static const Late at_exit(P);
    std::thread([&] {
        // Made before the thread has memory, and so ended after it.
        thread_local std::vector<double> first(1, dtw(P, P));
        thread_local const Late late(P);
        CHECK_EQUAL(late.prepared(P), first[0]);
    }).join();
    CHECK_EQUAL(at_exit.prepared(P), 0.0);
}

void blocks() {
    for (std::size_t bytes = 0; bytes < 300'000; bytes += 1 + bytes / 50) {
        void* const first = runtime::take_scratch(bytes);
        void* const other = runtime::take_scratch(bytes);
        CHECK(first != other);
        CHECK(reinterpret_cast<std::uintptr_t>(first) % alignof(std::max_align_t) == 0);
        std::memset(first, 1, bytes);
        std::memset(other, 2, bytes);
        if (bytes > 0) CHECK_EQUAL(static_cast<int>(*static_cast<char*>(first)), 1);
        runtime::give_scratch(first, bytes);
        void* const again = runtime::take_scratch(bytes);
        if (runtime::keeps_scratch) CHECK(again == first);
        runtime::give_scratch(again, bytes);
        runtime::give_scratch(other, bytes);
    }
}

}  // namespace

int main() {
    return check::run(
        {{"blocks", blocks},
         {"pairs", pairs},
         {"options of dtw", options_of_dtw},
         {"options of areas", options_of_areas},
         {"batches", batches},
         {"results", results},
         {"searches", searches},
         {"a call within a call", a_call_within_a_call},
         {"an exception", an_exception},
         {"kept memory is bounded", kept_memory_is_bounded},
         {"a thread ends with its memory", a_thread_ends_with_its_memory},
         {"a prepared curve that another thread ends", a_prepared_curve_that_another_thread_ends},
         {"objects that end late", objects_that_end_late}});
}
