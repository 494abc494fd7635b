// The boundary between the library and its kernels: plain pointers and sizes, so that a kernel may
// be compiled for another instruction set than the rest. No Eigen type, no standard container, no
// allocation and no exception crosses it.
//
// The cumulative table is cut into strips of rows. A strip is swept by anti-diagonals: on diagonal
// t, lane k is the cell of row k (of the strip) and column t - k. `before` and `before_last` hold
// the two last diagonals, lane k at index k + 1. Index 0 holds the cell above lane 0, from the
// strip above. So for lanes a..b of diagonal t, these are contiguous:
//
//   up = before[a..b],  left = before[a+1..b+1],  diagonal = before_last[a..b]
//
// Q is stored reversed, so that its points are contiguous, too. Only the strip's bottom row leaves
// it: `boundary` is the row above before the sweep and the bottom row after it. Column j is written
// rows - 1 diagonals after it was read.
#pragma once

#include <cstddef>
#include <cstdint>

#include "beside.hpp"
#include "block.hpp"
#include "boxes.hpp"
#include "curvewise/ground_distance.hpp"
#include "diagonals.hpp"
#include "line.hpp"
#include "narrow.hpp"
#include "runs.hpp"
#include "soft.hpp"

namespace curvewise::kernels {

// Lanes may be computed past the last active one, up to a whole SIMD vector. So every array that a
// sweep uses is this much longer than its content, and P and Q are finite there.
inline constexpr std::ptrdiff_t padding = 8;

// The rows of a strip whose values stay in registers.
inline constexpr std::ptrdiff_t resident_rows = 32;

// How a cell follows from its predecessors.
enum class Rule { dtw_symmetric1, dtw_symmetric2, frechet };

// The predecessor of a cell, as stored per cell if a path is requested.
enum Predecessor : std::uint8_t { diagonal = 0, up = 1, left = 2 };

struct Strip {
    // Coordinate c of row k is p[c * p_stride + k]; of column j, q[c * q_stride + columns - 1 - j].
    const double* p;
    const double* q;
    std::ptrdiff_t p_stride;
    std::ptrdiff_t q_stride;
    std::ptrdiff_t dim;
    std::ptrdiff_t rows;
    std::ptrdiff_t columns;
    double metric_parameter;  // the order of minkowski, the radius of haversine

    // Row k may hold columns first_column[k]..last_column[k]; both never fall from row to row.
    const std::ptrdiff_t* first_column;
    const std::ptrdiff_t* last_column;

    double* boundary;

    // The state between two calls: the next diagonal, and the active lanes of the last one.
    std::ptrdiff_t next_diagonal;
    std::ptrdiff_t low_lane;
    std::ptrdiff_t high_lane;
    double* before;
    double* before_last;
    double* current;
    double* cost;  // one diagonal of ground distances, for those that are not fused

    // If requested: the column at which the path of a cell leaves the row above the region. These
    // columns have separate lanes and a separate boundary row, and move along with the values.
    double* origin_boundary;
    double* origin_before;
    double* origin_before_last;
    double* origin_current;

    // If requested: the predecessor of lane k on diagonal t, at codes[t * code_stride + k]; the
    // cell of row k and column j, at table[k * table_stride + j].
    std::uint8_t* codes;
    std::ptrdiff_t code_stride;
    double* table;
    std::ptrdiff_t table_stride;

    // Where they are of the caller's own: the distance of row k and column j, at
    // own[k * own_stride + j].
    const double* own;
    std::ptrdiff_t own_stride;
};

// Writes the ground distances of lanes low..high of diagonal t to strip.cost.
using CostFunction = void (*)(const Strip& strip, std::ptrdiff_t t, std::ptrdiff_t low,
                              std::ptrdiff_t high) noexcept;

// Makes distances of squares of half chords of the unit sphere, in place.
using ArcFunction = void (*)(double* values, std::ptrdiff_t count, double radius) noexcept;

// Sweeps the diagonals from strip.next_diagonal to `end`, which is not swept. `fill` is called
// per diagonal where the cost is not fused.
using AdvanceFunction = void (*)(Strip& strip, std::ptrdiff_t end, CostFunction fill) noexcept;

// Narrow: if few lanes are expected to be active at a time.
enum class Output { boundary_only, origins, codes, narrow_codes, table };

// A ground distance, and whether every sum of squares is 0 or within the domain of the fast square
// root; or the caller's custom distance, which replaces the metric.
struct Cost {
    Metric metric;
    bool squares_in_domain;
    bool is_own = false;
};

// What one instruction-set level offers.
struct KernelSet {
    AdvanceFunction (*advance)(Rule rule, Cost cost, std::ptrdiff_t dim, Output output) noexcept;
    // The same for strips of at most resident_rows rows that hold all of their columns, if only the
    // bottom row is needed. Null if it would not be faster for a region with this shorter side.
    AdvanceFunction (*resident)(Rule rule, Cost cost, std::ptrdiff_t dim,
                                std::ptrdiff_t shorter_side) noexcept;
    CostFunction (*fill)(Cost cost) noexcept;
    // Null for a ground distance without bounds.
    ReachFunction (*reach)(Metric metric, std::ptrdiff_t dim) noexcept;
    ValueFunction (*values)(Metric metric, std::ptrdiff_t dim) noexcept;
    LeastFunction (*least)(Metric metric, std::ptrdiff_t dim) noexcept;
    RunFunction (*runs)(Metric metric, std::ptrdiff_t dim, bool of_largest) noexcept;
    ExtremesFunction extremes;
    SumFunction sum;
    // In one dimension, of squares or else of differences.
    LineFunction (*line)(Metric metric) noexcept;
    std::ptrdiff_t line_height;
    NarrowFunction narrow;
    std::ptrdiff_t lanes;  // of a SIMD vector: the rows that it takes
    // Several pairs at once.
    BesideKernels (*beside)(Rule rule, Cost cost, std::ptrdiff_t dim) noexcept;
    DiagonalFunction scan_diagonals;
    ArcFunction arcs;
    SoftForward soft_forward;
    SoftForward soft_forward_with_shares;
    SoftBackward soft_backward;
};

extern const KernelSet baseline;
#ifdef CURVEWISE_X86_64_LEVELS
extern const KernelSet v3;  // AVX2 and FMA
extern const KernelSet v4;  // AVX-512 F, BW, CD, DQ and VL
#endif

}  // namespace curvewise::kernels
