// A measure, as the rest of the library uses it: one class, which checks its options, prepares each
// side of a pair, and computes a pair. The call for one pair (evaluate.hpp), cdist, pdist and
// Prepared (batch_of.hpp), with progress, cutoff, threads and Ctrl-C, are made from it. A measure M
// has these members:
//
//   explicit M(const MOptions&)          throws std::invalid_argument for options out of range
//   M::Memory                            data that one thread keeps from one pair to the next
//   M::PreparedP, M::PreparedQ           all data that depends on one curve alone; made from a
//                                        CheckedCurve, which they keep as `checked`, and a Poller,
//                                        which can stop the preparation, too
//   M::is_swept                          whether several threads may work on one pair, while the
//                                        poller counts the pair's steps
//   requirements()                       of every curve
//   check_sizes(n, m)                    throws if no pair of n and m points has a value
//   may_be_negative()                    whether some value is below 0
//   is_zero_to_itself(checked)           whether the value of a curve and itself is known to be 0
//   check_p(prepared_p, poller)          throws the error of the value if P is invalid for every Q:
//                                        for batches, which check before any work
//   M::checks_p                          whether it ever throws: if not, an index prepares no curve
//                                        for it
//   workers()                            the threads for a single pair
//   M::steps(n, count, points)           the nominal steps of a curve of n points against `count`
//                                        curves of `points` points in all
//   (prepared_p, prepared_q, call)       the value
//
// An owner of many Qs stores their points itself (stored_curve.hpp). A PreparedQ may
//
//   PreparedQ::layout                  name the layout in which it reads stored points, otherwise
//                                      row by row
//   (stored, dim)                      be made of stored points in little time, and refer to them:
//                                      it is then made whenever it is needed, unless it is on the
//                                      sphere
//   (checked, poller, PointsStay())    be kept, and refer to the points instead of holding a copy
//
// The measure may have bounds, for searches that test a bound before they compute a value
// (targets.hpp):
//
//   M::Bounds                            the stored data of all Qs for the bounds, added by
//                                        keep(prepared_q) after reserve(measure, curves), or by
//                                        make_room(others) and then take(others), which does not
//                                        throw, empties the others, and changes nothing that a
//                                        query reads; has
//     row_shape(measure)                 the shape of the rows for trees over the first bounds,
//                                        where there is a Q; its width is 0 for no trees
//     write_row(j, row)                  that of Q number j
//   M::Bounds::format                    what files name the kind of the stored data, or 0 where it
//                                        cannot be stored; otherwise there are
//     stored_size(points, dim)           how many doubles it takes for a Q
//     write(j, to)                       writes that of Q number j
//     look_at(points, dim, stored)       adds what was written, without a copy
//   M::Bounds::levels                    the number of bounds of a pair, from cheap to expensive
//   M::Bounds::Query                     of one P: made from (measure, bounds, prepared_p);
//     quick(first, count, out)           the first bound of each of `count` Qs from `first` on
//     quick(first, leaf, out)            of those of a leaf of a tree (bound_tree.hpp)
//     of_boxes(boxes, count, out)        a bound for each of these boxes around rows
//     refined(j, prepared_q, level)      a later one
//     value(j, prepared_q, call)         the value, as the measure gives it
//     is_within(j, prepared_q, call)     whether that is at most the call's cutoff
//
// The measure may compute one P with several Qs at once, in less time than one by one, with values
// of the same bits. Then it has
//
//   M::Beside                          several Qs, and the memory of one thread
//     most(measure, n, m, dim)         of how many Qs of m points, with Ps of n points; 1 where
//                                      one by one is as fast
//     effort(measure, n, m, dim)       the cost of a pair
//     gather(measure, Qs, count, has_cutoff)
//                                      takes the first of the Qs, given as pointers, the longest
//                                      first; returns how many, 0 where the first is not for this
//     values(measure, prepared_p, first, out, poller)
//                                      writes those of the Qs from `first` on, and counts their
//                                      steps; false, and nothing done, where P is not for this
//     candidates(measure, cutoff, prepared_p, first, places, saved, poller)
//                                      writes the places, from `first` on, of Qs whose values may
//                                      be at most the cutoff, and returns how many; counts the
//                                      steps of the others, and writes the saved time, divided by
//                                      that of the bounds; -1 if all are computed in less time
//     bounds(measure, cutoff, prepared_p, out, poller)
//                                      writes a lower bound of the value of each Q, or of one that
//                                      is above the cutoff some bound that is, too; false, and
//                                      nothing done, if a curve lacks one
//     pair_values(measure, Ps, Qs, count, out, poller)
//                                      the same as values() for pairs, given as pointers; all Ps
//                                      have as many points as each other, and so have the Qs
//
// For other results of its functions (a path, a table), it has further members that take the same
// three arguments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "curves/checks.hpp"
#include "pairwise/stored_curve.hpp"
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
    static constexpr bool checks_p = false;
    template <class PreparedP>
    static void check_p(const PreparedP& /*P*/, Poller& /*poller*/) noexcept {}
};

// What measures have in common whose time is linear in the points of their two plane curves.
class LinearMeasure : public Distance {
   public:
    static constexpr bool is_swept = false;
    struct Memory {};

    static void check_sizes(std::ptrdiff_t /*n*/, std::ptrdiff_t /*m*/) noexcept {}
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
    static std::ptrdiff_t workers() noexcept { return 1; }
    static std::int64_t steps(std::int64_t n, std::int64_t /*count*/,
                              std::int64_t points) noexcept {
        return n * points;
    }
};

// For sides that may refer to the points of their curve, because these outlive them.
struct PointsStay {};

// A side of a measure that prepares nothing.
struct UnpreparedCurve {
    UnpreparedCurve(CheckedCurve curve, Poller& /*poller*/) : checked(std::move(curve)) {}
    UnpreparedCurve(const StoredCurve& stored, std::ptrdiff_t dim) noexcept
        : checked(stored.view(dim, PointLayout::rows), stored.largest, false) {}
    CheckedCurve checked;
};

}  // namespace curvewise::pairwise
