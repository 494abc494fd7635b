// Every call when memory runs out: each of its allocations fails in turn. The call then throws
// std::bad_alloc, or continues without the memory (for example, if a thread cannot be started) and
// has the same value. In either case nothing is leaked, and no other exception is thrown. The
// global operators new and delete are replaced; Windows has separate functions for aligned memory.
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.h"
#include "curvewise/curvewise.hpp"
#include "runtime/scratch.hpp"
#ifdef _WIN32
#include <malloc.h>
#endif

namespace {

std::atomic<std::int64_t> until_failure{-1};  // allocations; negative: all succeed
std::atomic<std::int64_t> living{0};

void* allocated(std::size_t size, std::size_t alignment) noexcept {
    if (until_failure.load() >= 0 && until_failure.fetch_sub(1) == 0) return nullptr;
    const std::size_t whole = size > 0 ? size : 1;  // zero bytes need a distinct place, too
#ifdef _WIN32
    void* const memory = _aligned_malloc(whole, alignment);
#else
    const std::size_t rounded = (whole + alignment - 1) / alignment * alignment;
    void* const memory = std::aligned_alloc(alignment, rounded);
#endif
    if (memory != nullptr) ++living;
    return memory;
}

void freed(void* memory) noexcept {
    if (memory == nullptr) return;
    --living;
#ifdef _WIN32
    _aligned_free(memory);
#else
    std::free(memory);
#endif
}

constexpr std::size_t usual = alignof(std::max_align_t);

void* allocated_or_thrown(std::size_t size, std::size_t alignment) {
    if (void* const memory = allocated(size, alignment)) return memory;
    throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return allocated_or_thrown(size, usual); }
void* operator new[](std::size_t size) { return allocated_or_thrown(size, usual); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocated_or_thrown(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
    return allocated(size, usual);
}
void* operator new[](std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
    return allocated(size, usual);
}
void operator delete(void* memory) noexcept { freed(memory); }
void operator delete[](void* memory) noexcept { freed(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { freed(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { freed(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { freed(memory); }
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
    freed(memory);
}

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;

// Fails each allocation of `call`, which returns a value, in turn: the first 256, then fewer and
// fewer. Returns how many there are.
std::int64_t fail_each(const std::string& name, const std::function<double()>& call) {
    const check::Note note(name);
    const double expected = call();
    std::int64_t thrown = 0, done_without = 0;
    for (std::int64_t k = 0;; k += 1 + k / 256 * (k / 256)) {
        runtime::release_scratch();  // so that the call has to allocate
        const std::int64_t before = living;
        until_failure = k;
        bool is_bad_alloc = false;
        double value = expected;
        std::string other;
        try {
            value = call();
        } catch (const std::bad_alloc&) {
            is_bad_alloc = true;
        } catch (const std::exception& error) {
            until_failure = -1;
            other = error.what();
        }
        const bool has_failed = until_failure.exchange(-1) < 0;
        CHECK_EQUAL(other, std::string());
        CHECK_EQUAL(value, expected);
        runtime::release_scratch();
        if (other.empty()) CHECK_EQUAL(living.load(), before);
        if (!has_failed) {
            std::printf("%-28s %4d allocations: %4d thrown, %d done without\n", name.c_str(),
                        static_cast<int>(k), static_cast<int>(thrown),
                        static_cast<int>(done_without));
            return k;
        }
        thrown += is_bad_alloc;
        done_without += !is_bad_alloc;
    }
}

struct Pair {
    Curve P, Q;
};

// Long enough for pruning, and for threads; similar enough for pruning to continue.
Pair long_pair() {
    Random random(8);
    Curve P = random.walk(3000), Q = P.part(0, 2800);
    for (std::ptrdiff_t i = 0; i < Q.size(); ++i) Q(i, 0) += 0.01 * static_cast<double>(i % 7);
    return {P, Q};
}

void single_calls() {
    Random random(5);
    const Curve P = random.walk(40), Q = random.walk(30);
    for_each_measure([&](auto options) {
        if constexpr (std::is_same_v<decltype(options), CurveLengthOptions>) {
            options.scale = LengthScale::range;
        }
        fail_each(options.measure, [&] { return evaluate(options, P, Q); });
    });
    PcmOptions all;
    all.continuous = true;
    fail_each("pcm, continuous", [&] { return pcm(P, Q, all); });
    fail_each("area by arc length", [&] { return area(P, Q, {Spacing::arc_length}); });
    fail_each("area, matched", [&] { return area(P, Q, {Spacing::matched}); });
    fail_each("area_quads, matched",
              [&] { return area_quads(P, Q, {Spacing::matched}).areas.back(); });
    for (const Crossing crossing : {Crossing::split, Crossing::polygon}) {
        const AreaOptions closed{Spacing::distance, crossing, false, true};
        fail_each("area_quads, closed", [&] { return area_quads(P, Q, closed).areas.back(); });
    }
    fail_each("common_part", [&] { return common_part(P, Q, 1.0).length; });
    fail_each("area_quads", [&] { return area_quads(P, Q).areas.back(); });
    fail_each("pcm_match", [&] { return pcm_match(P, Q).value; });
    fail_each("dtw_path", [&] { return dtw_path(P, Q).distance; });
    fail_each("frechet_path", [&] { return frechet_path(P, Q).distance; });
    std::vector<double> out(static_cast<std::size_t>(P.size() * Q.size()));
    fail_each("dtw_table", [&] {
        dtw_table(P, Q, out.data());
        return out.back();
    });
    fail_each("residuals", [&] {
        curve_length_residuals(P, Q, out.data(), {LengthScale::range});
        return out[0];
    });
    fail_each("mse", [&] { return mse(P, P.times_power_of_two(1)); });
    fail_each("compare", [&] { return compare(P, Q).dtw; });
}

void continuous_calls() {
    Random random(9);
    const Curve P = random.walk(40), Q = random.walk(30), high = random.curve(20, 5),
                other_high = random.curve(30, 5);
    fail_each("frechet_continuous", [&] { return frechet_continuous(P, Q); });
    fail_each("frechet_continuous, 5-D", [&] { return frechet_continuous(high, other_high); });
    fail_each("its bounds", [&] { return frechet_continuous_bounds(P, Q).low; });
    fail_each("its path", [&] { return frechet_continuous_path(P, Q).parameters[7][0]; });
    for (const bool continuous : {true, false}) {
        fail_each(continuous ? "frechet_within" : "frechet_within, discrete",
                  [&] { return frechet_within(P, Q, 3.0, continuous) ? 1.0 : 0.0; });
    }
}

void gradients() {
    Random random(10);
    const Curve P = random.walk(40), Q = random.walk(30);
    std::vector<double> gradient(P.values().size());
    const auto fails = [&](const std::string& name, const auto& options) {
        fail_each("gradient of " + name, [&] {
            const double value = value_and_gradient(options, P, Q, gradient.data());
            return value + gradient[5];
        });
    };
    fails("dtw", DtwOptions{});
    fails("frechet", FrechetOptions{});
    fails("curve_length", CurveLengthOptions{LengthScale::range});
    fails("area", AreaOptions{});
    fails("area, matched", AreaOptions{Spacing::matched});
    fail_each("gradient of sum_of_squares", [&] {
        return sum_of_squares_and_gradient(P, P.times_power_of_two(1), gradient.data());
    });
}

// An index that could not be made, or not be added to, is as it was.
void nearest_curves() {
    Random random(11);
    std::vector<Curve> curves;
    for (int i = 0; i < 8; ++i) curves.push_back(random.walk(20 + i));
    const std::vector<CurveView> X = views_of(curves);
    std::vector<double> distances(3 * X.size());
    std::vector<std::int64_t> places(3 * X.size());
    for_each_measure([&](auto options) {
        if constexpr (std::is_same_v<decltype(options), CurveLengthOptions>) {
            options.scale = LengthScale::range;
        }
        const std::string of = std::string(" of ") + options.measure;
        fail_each("Index" + of, [&] { return static_cast<double>(Index(X, options).size()); });
        const Index index(X, options);
        for (const std::ptrdiff_t workers : {1, 3}) {
            fail_each("kneighbors" + of, [&] {
                index.kneighbors(3, distances.data(), places.data(), {workers});
                return distances[4];
            });
        }
        fail_each("radius_neighbors" + of, [&] {
            return static_cast<double>(index.radius_neighbors(X, 2.0).back().size());
        });
    });
    fail_each("Index.add", [&] {
        Index index({X[0]}, DtwOptions{});
        try {
            index.add(X);
        } catch (const std::bad_alloc&) {
            CHECK_EQUAL(index.size(), std::size_t{1});
            throw;
        }
        index.kneighbors({X[1]}, 1, distances.data(), places.data());
        return distances[0];
    });
    fail_each("subsequences", [&] { return subsequences(X[0], X[7], 2)[0].distance; });
    fail_each("subsequences of frechet",
              [&] { return subsequences(X[0], X[7], 2, FrechetOptions{})[0].distance; });
    const std::vector<double> weights(X.size(), 1.0);
    for (const std::ptrdiff_t workers : {1, 3}) {
        DtwMeanOptions options;
        options.iterations = 2;
        options.workers = workers;
        fail_each("dtw_mean, " + std::to_string(workers) + " workers",
                  [&] { return dtw_mean(X, weights, X[0], options).costs.back(); });
    }
}

void long_calls() {
    const Pair pair = long_pair();
    const auto &P = pair.P, &Q = pair.Q;  // names of a binding are not for lambdas to capture
    for (const std::ptrdiff_t workers : {1, 3}) {
        const std::string with = ", " + std::to_string(workers) + " workers";
        DtwOptions dtw_options;
        FrechetOptions frechet_options;
        dtw_options.workers = frechet_options.workers = workers;
        fail_each("dtw, pruned" + with, [&] { return dtw(P, Q, dtw_options); });
        fail_each("dtw_path, pruned" + with, [&] { return dtw_path(P, Q, dtw_options).distance; });
        fail_each("frechet, pruned" + with, [&] { return frechet(P, Q, frechet_options); });
        fail_each("frechet_path, pruned" + with,
                  [&] { return frechet_path(P, Q, frechet_options).distance; });
        dtw_options.prune = false;
        fail_each("dtw" + with, [&] { return dtw(P, Q, dtw_options); });
    }
}

void batches() {
    Random random(6);
    std::vector<Curve> curves;
    for (int i = 0; i < 6; ++i) curves.push_back(random.walk(10 + i));
    const std::vector<CurveView> X = views_of(curves);
    std::vector<double> out(X.size() * X.size());
    for (const std::ptrdiff_t workers : {1, 3}) {
        const std::string with = ", " + std::to_string(workers) + " workers";
        fail_each("cdist, dtw" + with, [&] {
            cdist(X, DtwOptions{}, out.data(), {workers});
            return out[1];
        });
        fail_each("cdist, pcm" + with, [&] {
            cdist(X, X, PcmOptions{}, out.data(), {workers});
            return out[1];
        });
        fail_each("pdist, frechet" + with, [&] {
            pdist(X, FrechetOptions{}, out.data(), {workers});
            return out[0];
        });
        fail_each("Prepared" + with, [&] {
            Prepared(X[0], AreaOptions{})(X, out.data(), {workers});
            return out[1];
        });
    }
}

// In C it is a status.
void from_c() {
    Random random(7);
    const Curve P = random.walk(40), Q = random.walk(30);
    const curvewise_curve p = curvewise_rows(P.values().data(), P.size(), 2);
    const curvewise_curve q = curvewise_rows(Q.values().data(), Q.size(), 2);
    curvewise_batch_options threads = CURVEWISE_BATCH_DEFAULTS;
    threads.workers = 3;
    const curvewise_curve curves[] = {p, q, p, q};
    // `call` returns a status; it writes `out`.
    double out[80] = {};
    curvewise_error error;
    const auto fails = [&](const std::string& name, const std::function<int()>& call) {
        fail_each("curvewise_" + name, [&] {
            const int status = call();
            if (status == CURVEWISE_NO_MEMORY) throw std::bad_alloc();
            return status == CURVEWISE_OK ? out[1] : -1.0;
        });
    };
    curvewise_curve_length_options by_range = CURVEWISE_CURVE_LENGTH_DEFAULTS;
    by_range.scale = CURVEWISE_RANGE;
    fails("area", [&] { return curvewise_area(&p, &q, nullptr, &out[1], &error); });
    fails("pcm", [&] { return curvewise_pcm(&p, &q, nullptr, &out[1], &error); });
    fails("frechet", [&] { return curvewise_frechet(&p, &q, nullptr, &out[1], &error); });
    fails("dtw", [&] { return curvewise_dtw(&p, &q, nullptr, &out[1], &error); });
    fails("curve_length",
          [&] { return curvewise_curve_length(&p, &q, &by_range, &out[1], &error); });
    fails("frechet_continuous",
          [&] { return curvewise_frechet_continuous(&p, &q, nullptr, &out[1], &error); });
    fails("normalize", [&] { return curvewise_normalize(&p, &q, out, &error); });
    fails("cdist", [&] {
        return curvewise_cdist(curves, 4, curves, 4, CURVEWISE_DTW, nullptr, &threads, out, &error);
    });
    fails("pdist", [&] {
        return curvewise_pdist(curves, 4, CURVEWISE_FRECHET, nullptr, &threads, out, &error);
    });
}

}  // namespace

int main() {
    return check::run({{"single calls", single_calls},
                       {"continuous calls", continuous_calls},
                       {"gradients", gradients},
                       {"nearest curves", nearest_curves},
                       {"long calls", long_calls},
                       {"batches", batches},
                       {"from C", from_c}});
}
