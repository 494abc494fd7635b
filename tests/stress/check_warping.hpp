// dtw and frechet, by every way to compute them, against the textbook (textbook_warping.hpp), to
// the last bit: single calls, C, paths, tables, infos, cutoffs, batches on 1 to 3 threads, pdist,
// Prepared, the nearest of an index, runs of a long curve. Powers are not correctly rounded, so
// orders of minkowski other than 1, 2 and infinity are compared to 1e-12 instead.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "curvewise/curvewise.h"
#include "curvewise/curvewise.hpp"
#include "hard_curves.hpp"
#include "record.hpp"
#include "textbook_warping.hpp"

namespace stress {

using curvewise::CurveView;
using curvewise::DtwOptions;
using curvewise::FrechetOptions;
using textbook::infinity;

inline std::ptrdiff_t any_workers(Choices& choices) {
    return choices.one_in(8) ? choices.between(2, 3) : 1;
}

inline curvewise::GroundDistance any_ground_distance(Choices& choices) {
    constexpr double orders[] = {1.0, 2.0, infinity, 1.5, 3.0, 40.0, 1.0 + 0x1p-52};
    curvewise::GroundDistance ground;
    ground.metric = oracle::metrics[static_cast<std::size_t>(
        choices.index(static_cast<std::ptrdiff_t>(oracle::metrics.size())))];
    if (ground.metric == curvewise::Metric::minkowski) ground.p = orders[choices.index(7)];
    return ground;
}

// Options with which any two curves of up to `longest` points have a path.
inline DtwOptions any_dtw_options(Choices& choices, std::ptrdiff_t longest) {
    DtwOptions options;
    options.ground = any_ground_distance(choices);
    options.prune = !choices.one_in(3);
    options.workers = any_workers(choices);
    switch (choices.index(4)) {
        case 0:
            options.window = choices.between(1, longest + 1);
            break;
        case 1:
            options.open_begin = choices.one_in(2);
            options.open_end = choices.one_in(2);
            return options;
        case 2:
            options.window_fraction = choices.uniform(0.3, 0.999);
            break;
        default:
            break;
    }
    if (choices.one_in(2)) {
        options.step_pattern = curvewise::StepPattern::symmetric2;
        options.normalize = choices.one_in(3);
    }
    return options;
}

inline FrechetOptions any_frechet_options(Choices& choices) {
    FrechetOptions options;
    options.ground = any_ground_distance(choices);
    options.prune = !choices.one_in(3);
    options.workers = any_workers(choices);
    return options;
}

inline textbook::Rules rules_of(const DtwOptions& options, std::ptrdiff_t n, std::ptrdiff_t m) {
    textbook::Rules rules;
    rules.ground = options.ground;
    rules.diagonal_weight = options.step_pattern == curvewise::StepPattern::symmetric2 ? 2.0 : 1.0;
    rules.window = options.window;
    if (options.window_fraction) {
        rules.window = static_cast<std::ptrdiff_t>(*options.window_fraction *
                                                   static_cast<double>(std::max(n, m)));
    }
    rules.open_begin = options.open_begin;
    rules.open_end = options.open_end;
    return rules;
}

inline textbook::Rules rules_of(const FrechetOptions& options, std::ptrdiff_t /*n*/,
                                std::ptrdiff_t /*m*/) {
    textbook::Rules rules;
    rules.ground = options.ground;
    rules.largest = true;
    return rules;
}

inline double divisor(const DtwOptions& options, std::ptrdiff_t n, std::ptrdiff_t m) {
    return options.normalize ? static_cast<double>(n + m) : 1.0;
}
inline double divisor(const FrechetOptions& /*options*/, std::ptrdiff_t /*n*/,
                      std::ptrdiff_t /*m*/) {
    return 1.0;
}

// A window of 0, or a fraction that comes to 0, has a path only where there are as many points.
inline bool has_path(const textbook::Rules& rules, std::ptrdiff_t n, std::ptrdiff_t m) {
    return rules.window != 0 || n == m || n == 1 || m == 1;
}

inline double single(const DtwOptions& options, const Curve& P, const Curve& Q) {
    return curvewise::dtw(P, Q, options);
}
inline double single(const FrechetOptions& options, const Curve& P, const Curve& Q) {
    return curvewise::frechet(P, Q, options);
}
inline curvewise::Alignment aligned(const DtwOptions& options, const Curve& P, const Curve& Q) {
    return curvewise::dtw_path(P, Q, options);
}
inline curvewise::Alignment aligned(const FrechetOptions& options, const Curve& P, const Curve& Q) {
    return curvewise::frechet_path(P, Q, options);
}
inline curvewise::WarpingInfo info(const DtwOptions& options, const Curve& P, const Curve& Q) {
    return curvewise::dtw_info(P, Q, options);
}
inline curvewise::WarpingInfo info(const FrechetOptions& options, const Curve& P, const Curve& Q) {
    return curvewise::frechet_info(P, Q, options);
}
inline void write_table(const DtwOptions& options, const Curve& P, const Curve& Q, double* out) {
    curvewise::dtw_table(P, Q, out, options);
}
inline void write_table(const FrechetOptions& options, const Curve& P, const Curve& Q,
                        double* out) {
    curvewise::frechet_table(P, Q, out, options);
}

inline curvewise_curve as_c(const Curve& curve) {
    return curvewise_rows(curve.values().data(), curve.size(), curve.dim());
}

inline int call_c(const DtwOptions& options, const curvewise_curve& P, const curvewise_curve& Q,
                  double* value) {
    curvewise_dtw_options given = CURVEWISE_DTW_DEFAULTS;
    given.metric = static_cast<int>(options.ground.metric);
    given.p = options.ground.p;
    given.step_pattern = static_cast<int>(options.step_pattern);
    given.open_begin = options.open_begin ? 1 : 0;
    given.open_end = options.open_end ? 1 : 0;
    given.window = options.window.value_or(CURVEWISE_NO_WINDOW);
    given.window_fraction = options.window_fraction.value_or(0.0);
    given.workers = options.workers;
    given.prune = options.prune ? 1 : 0;
    given.cutoff = options.cutoff;
    given.normalize = options.normalize ? 1 : 0;
    return curvewise_dtw(&P, &Q, &given, value, nullptr);
}

inline int call_c(const FrechetOptions& options, const curvewise_curve& P, const curvewise_curve& Q,
                  double* value) {
    curvewise_frechet_options given = CURVEWISE_FRECHET_DEFAULTS;
    given.metric = static_cast<int>(options.ground.metric);
    given.p = options.ground.p;
    given.workers = options.workers;
    given.prune = options.prune ? 1 : 0;
    given.cutoff = options.cutoff;
    return curvewise_frechet(&P, &Q, &given, value, nullptr);
}

// Holds values to the textbook's: to the bit, or, of powers, to 1e-12.
class Judge {
   public:
    Judge(Record& record, const char* measure, const curvewise::GroundDistance& ground)
        : record_(record), measure_(measure), is_exact_(textbook::is_exact(ground)) {}

    void value(const char* way, double actual, double expected, const About& with) const {
        const std::string what = std::string(measure_) + (is_exact_ ? " " : " (powers) ") + way;
        if (is_exact_) return record_.same(what, actual, expected, with);
        // Two numbers beyond the range, or near its end, count as equal, too.
        const bool both_large = actual > 0x1.fffp1023 && expected > 0x1.fffp1023;
        const double allowed = both_large ? infinity : 1e-12 * expected + 0x1p-1060;
        record_.close(what, actual, expected, allowed, with);
    }
    void holds(const char* way, bool condition, const About& with) const {
        record_.is_true(std::string(measure_) + " " + way, condition, with);
    }
    bool is_exact() const noexcept { return is_exact_; }

   private:
    Record& record_;
    const char* measure_;
    bool is_exact_;
};

inline double cut(double value, double cutoff) { return value > cutoff ? infinity : value; }

// A cutoff equal to the value, a little less, a little more, much less, or infinity.
inline double any_cutoff(Choices& choices, double value) {
    switch (choices.index(6)) {
        case 0:
            return value;
        case 1:
            return value > 0.0 ? std::nextafter(value, 0.0) : value;
        case 2:
            return std::nextafter(value, infinity);
        case 3:
            return 0.5 * value;
        case 4:
            return 0.0;
        default:
            return infinity;
    }
}

// One pair by every function that takes one.
template <class Options>
void check_pair(Choices& choices, const Judge& judge, Options options, const Curve& P,
                const Curve& Q, const About& with) {
    const textbook::Rules rules = rules_of(options, P.size(), Q.size());
    const textbook::Answer expected = textbook::answer(P, Q, rules);
    const double value = expected.value / divisor(options, P.size(), Q.size());
    judge.value("value", single(options, P, Q), value, with);
    judge.value(
        "value through C",
        [&] {
            double found = -1.0;
            return call_c(options, as_c(P), as_c(Q), &found) == CURVEWISE_OK ? found : -1.0;
        }(),
        value, with);
    const curvewise::Alignment alignment = aligned(options, P, Q);
    judge.value("value of the path", alignment.distance, expected.value, with);
    if (judge.is_exact()) judge.holds("path", alignment.path == expected.path, with);
    judge.value("value of the info", info(options, P, Q).value, expected.value, with);
    std::vector<double> table(expected.table.size(), -1.0);
    write_table(options, P, Q, table.data());
    for (std::size_t k = 0; k < table.size(); ++k) {
        judge.value("cell of the table", table[k], expected.table[k], with);
    }
    if (!judge.is_exact()) return;
    options.cutoff = any_cutoff(choices, value);
    judge.value("value with a cutoff", single(options, P, Q), cut(value, options.cutoff), with);
}

// All pairs of two lists, and the functions built on many distances.
template <class Options>
class BatchCheck {
   public:
    BatchCheck(Choices& choices, const Judge& judge, const Options& options,
               const std::vector<Curve>& XA, const std::vector<Curve>& XB, const About& with)
        : choices_(choices),
          judge_(judge),
          options_(options),
          XA_(XA),
          XB_(XB),
          a_(XA.begin(), XA.end()),
          b_(XB.begin(), XB.end()),
          with_(with) {
        for (const Curve& P : XA) {
            for (const Curve& Q : XB) {
                const textbook::Rules rules = rules_of(options, P.size(), Q.size());
                expected_.push_back(textbook::value(P, Q, rules) /
                                    divisor(options, P.size(), Q.size()));
            }
        }
        batch_.workers = any_workers(choices);
        const auto any =
            static_cast<std::size_t>(choices.index(static_cast<std::ptrdiff_t>(expected_.size())));
        if (judge.is_exact()) batch_.cutoff = any_cutoff(choices, expected_[any]);
    }

    std::ptrdiff_t pairs() const { return static_cast<std::ptrdiff_t>(expected_.size()); }

    void run() {
        check_cdist();
        check_prepared();
        if (choices_.one_in(2) && curvewise::is_symmetric(options_)) check_one_list();
        if (choices_.one_in(2) && judge_.is_exact()) check_index();
    }

   private:
    double expected(std::size_t i, std::size_t j) const { return expected_[i * XB_.size() + j]; }

    void check_cdist() {
        std::vector<double> out(expected_.size(), -1.0);
        curvewise::cdist(a_, b_, options_, out.data(), batch_);
        for (std::size_t k = 0; k < out.size(); ++k) {
            judge_.value("cdist", out[k], cut(expected_[k], batch_.cutoff), with_);
        }
    }

    void check_prepared() {
        const auto i =
            static_cast<std::size_t>(choices_.index(static_cast<std::ptrdiff_t>(XA_.size())));
        const curvewise::Prepared prepared(a_[i], options_);
        std::vector<double> out(XB_.size(), -1.0);
        prepared(b_, out.data(), batch_);
        for (std::size_t j = 0; j < out.size(); ++j) {
            judge_.value("Prepared, many", out[j], cut(expected(i, j), batch_.cutoff), with_);
        }
        judge_.value("Prepared, one", prepared(b_[0]), expected(i, 0), with_);
    }

    void check_one_list() {
        const std::size_t count = XB_.size();
        std::vector<double> square(count * count, -1.0), condensed(count * (count - 1) / 2 + 1);
        curvewise::cdist(b_, options_, square.data(), batch_);
        curvewise::pdist(b_, options_, condensed.data(), batch_);
        for (std::size_t i = 0, k = 0; i < count; ++i) {
            judge_.value("diagonal", square[i * count + i], 0.0, with_);
            for (std::size_t j = i + 1; j < count; ++j, ++k) {
                const textbook::Rules rules = rules_of(options_, XB_[i].size(), XB_[j].size());
                if (!has_path(rules, XB_[i].size(), XB_[j].size())) continue;
                const double value = textbook::value(XB_[i], XB_[j], rules) /
                                     divisor(options_, XB_[i].size(), XB_[j].size());
                const double shown = cut(value, batch_.cutoff);
                judge_.value("pdist", condensed[k], shown, with_);
                judge_.value("cdist of one list", square[i * count + j], shown, with_);
                judge_.value("cdist of one list", square[j * count + i], shown, with_);
            }
        }
    }

    // By a table and a stable sort.
    void check_index() {
        const curvewise::Index index(b_, options_);
        const auto count =
            static_cast<std::size_t>(choices_.between(1, static_cast<std::ptrdiff_t>(XB_.size())));
        std::vector<double> distances(XA_.size() * count);
        std::vector<std::int64_t> places(XA_.size() * count);
        curvewise::SearchOptions search;
        search.workers = batch_.workers;
        index.kneighbors(a_, static_cast<std::ptrdiff_t>(count), distances.data(), places.data(),
                         search);
        const double radius = std::min(batch_.cutoff, 0x1.fffffffffffffp1023);
        const auto near = index.radius_neighbors(a_, radius, search);
        for (std::size_t i = 0; i < XA_.size(); ++i) {
            const std::vector<std::size_t> order = ranked(i);
            for (std::size_t k = 0; k < count; ++k) {
                judge_.value("distance of a neighbour", distances[i * count + k],
                             expected(i, order[k]), with_);
                judge_.holds("place of a neighbour",
                             places[i * count + k] == static_cast<std::int64_t>(order[k]), with_);
            }
            check_radius(i, order, radius, near[i]);
        }
    }

    std::vector<std::size_t> ranked(std::size_t i) const {
        std::vector<std::size_t> order(XB_.size());
        for (std::size_t j = 0; j < order.size(); ++j) order[j] = j;
        std::stable_sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
            return expected(i, x) < expected(i, y);
        });
        return order;
    }

    void check_radius(std::size_t i, const std::vector<std::size_t>& order, double radius,
                      const std::vector<curvewise::Neighbor>& found) const {
        std::size_t within = 0;
        while (within < order.size() && expected(i, order[within]) <= radius) ++within;
        judge_.holds("count within a radius", found.size() == within, with_);
        for (std::size_t k = 0; k < std::min(within, found.size()); ++k) {
            judge_.holds("place within a radius",
                         found[k].index == static_cast<std::int64_t>(order[k]), with_);
            judge_.value("distance within a radius", found[k].distance, expected(i, order[k]),
                         with_);
        }
    }

    Choices& choices_;
    const Judge& judge_;
    Options options_;
    const std::vector<Curve>& XA_;
    const std::vector<Curve>& XB_;
    std::vector<CurveView> a_, b_;
    const About& with_;
    curvewise::BatchOptions batch_;
    std::vector<double> expected_;
};

// The best run of Q for P, then the best of the rest before and behind it: by all possible runs,
// each with a separate table. Ends at the first difference.
template <class Options>
void check_subsequences(Choices& choices, const Judge& judge, const Options& options,
                        const Curve& P, const Curve& Q, const About& with) {
    if (!judge.is_exact() || Q.size() > 12) return;
    struct Piece {
        std::ptrdiff_t begin, end;
    };
    const textbook::Rules rules = rules_of(options, P.size(), Q.size());
    // That of a run of Q.
    const auto distance = [&](std::ptrdiff_t first, std::ptrdiff_t last) {
        return textbook::unscaled_value(P, Q.part(first, last + 1), rules);
    };
    std::vector<Piece> pieces{{0, Q.size()}};
    const auto found = curvewise::subsequences(P, Q, choices.between(1, 3), options);
    // The library scales once, by all of Q, and a run by itself may be scaled otherwise.
    if (textbook::range_exponent(P, Q) != 0) return;
    for (const curvewise::Subsequence& run : found) {
        double best = infinity;
        std::ptrdiff_t stop = -1;
        for (const Piece& piece : pieces) {
            for (std::ptrdiff_t last = piece.begin; last < piece.end; ++last) {
                double ending_here = infinity;
                for (std::ptrdiff_t first = piece.begin; first <= last; ++first) {
                    ending_here = std::min(ending_here, distance(first, last));
                }
                if (ending_here < best || (ending_here == best && last < stop)) {
                    best = ending_here;
                    stop = last;
                }
            }
        }
        judge.value("distance of a run", run.distance, best, with);
        judge.holds("stop of a run", run.stop == stop, with);
        std::vector<Piece> left;
        for (const Piece& piece : pieces) {
            if (run.stop < piece.begin || run.start >= piece.end) {
                left.push_back(piece);
                continue;
            }
            judge.holds("start of a run", run.start >= piece.begin && run.start <= run.stop, with);
            left.push_back({piece.begin, run.start});
            left.push_back({run.stop + 1, piece.end});
        }
        pieces = std::move(left);
        judge.value("distance from the run", distance(run.start, run.stop), best, with);
    }
}

template <class Options>
std::ptrdiff_t check_warping(Choices& choices, Record& record, const char* measure,
                             const Options& options, HardCurves& curves, std::ptrdiff_t long_size) {
    const Judge judge(record, measure, options.ground);
    std::vector<Curve> XA, XB;
    About with{std::string(measure) + " metric " +
                   std::to_string(static_cast<int>(options.ground.metric)) + " p " +
                   std::to_string(options.ground.p),
               {}};
    const std::ptrdiff_t na = choices.between(1, 3), nb = choices.between(1, 4);
    for (std::ptrdiff_t i = 0; i < na; ++i) {
        XA.push_back(curves.curve(any_size(choices, 1, long_size)));
    }
    for (std::ptrdiff_t j = 0; j < nb; ++j) {
        XB.push_back(curves.other(XA[0], any_size(choices, 1, long_size)));
    }
    for (const Curve& P : XA) with.curves.emplace_back("P", &P);
    for (const Curve& Q : XB) with.curves.emplace_back("Q", &Q);
    for (const auto* left : {&XA, &XB}) {
        for (const Curve& P : *left) {
            for (const Curve& Q : XB) {
                if (!has_path(rules_of(options, P.size(), Q.size()), P.size(), Q.size())) return 0;
            }
        }
    }
    check_pair(choices, judge, options, XA.back(), XB.back(), with);
    BatchCheck<Options> batch(choices, judge, options, XA, XB, with);
    batch.run();
    if constexpr (std::is_same_v<Options, FrechetOptions>) {
        check_subsequences(choices, judge, options, XA[0], XB[0], with);
    } else if (!options.window && !options.window_fraction &&
               options.step_pattern == curvewise::StepPattern::symmetric1) {
        check_subsequences(choices, judge, options, XA[0], XB[0], with);
    }
    return batch.pairs();
}

// Tables that are large enough for pruning, of curves similar enough for it, or not.
inline std::ptrdiff_t check_large(Choices& choices, Record& record) {
    const Kind kind = choices.one_in(4) ? Kind::walk : Kind::loop;
    const std::ptrdiff_t dim = choices.between(1, 3);
    HardCurves curves(choices, kind, dim);
    const Curve P = curves.curve(choices.between(1100, 1400));
    Curve Q = P;
    while (Q.size() == P.size()) Q = curves.other(P, choices.between(1110, 1300));
    const About with{"large, P and Q of " + std::to_string(P.size()) + ", " +
                         std::to_string(Q.size()) + " points",
                     {}};
    DtwOptions dtw = any_dtw_options(choices, P.size());
    FrechetOptions frechet = any_frechet_options(choices);
    while (!textbook::is_exact(dtw.ground)) dtw.ground = {};
    while (!textbook::is_exact(frechet.ground)) frechet.ground = {};
    const auto check = [&](const char* measure, auto options) {
        const Judge judge(record, measure, options.ground);
        const double value = textbook::unscaled_value(P, Q, rules_of(options, P.size(), Q.size())) /
                             divisor(options, P.size(), Q.size());
        judge.value("value of a large pair", single(options, P, Q), value, with);
        options.cutoff = any_cutoff(choices, value);
        judge.value("value of a large pair with a cutoff", single(options, P, Q),
                    cut(value, options.cutoff), with);
    };
    check("dtw", dtw);
    check("frechet", frechet);
    return 2;
}

inline std::ptrdiff_t check_warping(Choices& choices, Record& record) {
    const std::ptrdiff_t dim = any_dimension(choices);
    HardCurves curves(choices, any_kind(choices), dim);
    const std::ptrdiff_t long_size = dim > 4 ? 40 : 90;
    if (choices.one_in(2)) {
        const FrechetOptions options = any_frechet_options(choices);
        return check_warping(choices, record, "frechet", options, curves, long_size);
    }
    const DtwOptions options = any_dtw_options(choices, 12);
    return check_warping(choices, record, "dtw", options, curves, long_size);
}

}  // namespace stress
