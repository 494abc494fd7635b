// What a measure is to the rest of the library: one class, which checks its options, prepares each
// side of a pair, and computes a pair. The call for one pair (evaluate.hpp), cdist, pdist and
// Prepared (batch_of.hpp), with progress, cutoff, threads and Ctrl-C, are made from it. A measure M
// has
//
//   explicit M(const MOptions&)          throws std::invalid_argument for options out of range
//   M::Memory                            what one thread keeps from one pair to the next
//   M::PreparedP, M::PreparedQ           all that depends on one curve alone; made from a
//                                        CheckedCurve, which they keep as `checked`, and a Poller,
//                                        which ends that too
//   M::is_swept                          whether several threads may work on one pair, and the
//                                        poller hears of the pair's steps while they do
//   requirements()                       of every curve
//   check_sizes(n, m)                    throws where no pair of n and m points has a value
//   may_be_negative()                    whether some value is below 0
//   is_zero_to_itself(checked)           whether the value of a curve and itself is known to be 0
//   check_p(prepared_p, poller)          throws where P serves no Q, as the value would: for
//                                        batches, which refuse before any work
//   workers()                            the threads for a single pair
//   M::steps(n, count, points)           the nominal steps of a curve of n points against `count`
//                                        curves of `points` points in all
//   (prepared_p, prepared_q, call)       the value
//
// PreparedQ may have, where it holds the points of its curve in a form of its own, so that who
// keeps it need not keep them beside it,
//
//     holds_points()                     whether this one does
//     look_at_own_points()               makes `checked` look at these
//
// The measure may have, for searches that look at a bound before they compute a value
// (targets.hpp),
//
//   M::Bounds                            what is kept of all Qs for that, by keep(prepared_q), and
//                                        by make_room(others) and then take(others), which does
//                                        not throw and leaves the others empty
//   M::Bounds::levels                    how many bounds there are of a pair, from cheap to dear
//   M::Bounds::Query                     of one P: made from (measure, bounds, prepared_p);
//     quick(out)                         the first bound of every Q
//     refined(j, prepared_q, level)      a later one
//     value(j, prepared_q, call)         the value, as the measure gives it
//     is_within(j, prepared_q, call)     whether that is at most the call's cutoff
//
// and, for what else its functions return (a path, a table), members of its own that take the same
// three arguments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "curves/checks.hpp"
#include "runtime/poller.hpp"

namespace curvewise::pairwise {

using curves::CheckedCurve;
using runtime::Poller;

// How a pair is computed.
template <class Memory>
struct Call {
    double cutoff;  // a value above it may come back as any other that is
    std::ptrdiff_t workers;
    Poller& poller;
    Memory& memory;
};

// What measures have in common whose values are at least 0, and 0 of a curve and itself.
class Distance {
   public:
    static constexpr bool may_be_negative() noexcept { return false; }
    static constexpr bool is_zero_to_itself(const curves::CheckedCurve& /*checked*/) noexcept {
        return true;
    }
};

// What measures have in common whose time is linear in the points of their two plane curves.
class LinearMeasure : public Distance {
   public:
    static constexpr bool is_swept = false;
    struct Memory {};

    static void check_sizes(std::ptrdiff_t /*n*/, std::ptrdiff_t /*m*/) noexcept {}
    template <class PreparedP>
    void check_p(const PreparedP& /*P*/, Poller& /*poller*/) const noexcept {}
    static std::ptrdiff_t workers() noexcept { return 1; }
    static std::int64_t steps(std::int64_t n, std::int64_t count, std::int64_t points) noexcept {
        return n * count + points;
    }
};

// What measures have in common that sweep a table of n m cells; those that take several threads for
// a pair, or refuse some sizes, say so themselves.
class SweptMeasure : public Distance {
   public:
    static constexpr bool is_swept = true;

    static void check_sizes(std::ptrdiff_t /*n*/, std::ptrdiff_t /*m*/) noexcept {}
    template <class PreparedP>
    static void check_p(const PreparedP& /*P*/, Poller& /*poller*/) noexcept {}
    static std::ptrdiff_t workers() noexcept { return 1; }
    static std::int64_t steps(std::int64_t n, std::int64_t /*count*/,
                              std::int64_t points) noexcept {
        return n * points;
    }
};

// A side of a measure that prepares nothing.
struct UnpreparedCurve {
    UnpreparedCurve(CheckedCurve curve, Poller& /*poller*/) : checked(std::move(curve)) {}
    CheckedCurve checked;
};

}  // namespace curvewise::pairwise
