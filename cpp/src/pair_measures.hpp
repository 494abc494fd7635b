// Every measure taken apart: what depends on P alone (Reference), on Q alone (Other), and what is
// left for each pair. Both sides look at curves that the caller keeps. A side's constructor checks
// its curve and throws with its name: `what`, e.g. "XA[3]".
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "box.hpp"
#include "checks.hpp"
#include "curvewise/area.hpp"
#include "curvewise/curve_length.hpp"
#include "curvewise/pcm.hpp"
#include "offset_search.hpp"
#include "packed_curve.hpp"
#include "table_measure.hpp"
#include "watch.hpp"

namespace curvewise::detail {

// A curve found finite, with the largest |coordinate|.
struct CheckedCurve {
    CurveView curve;
    double largest;
    std::string name;
};

// How a pair is computed.
struct PairCall {
    double cutoff;  // a value above it may come back as any other that is
    std::ptrdiff_t workers;
    Watch& watch;
    SweepMemory& memory;
};

// dtw and frechet.
class TableMeasure {
   public:
    // Several threads may work on one pair, and the watch hears of its steps while they do.
    static constexpr bool is_swept = true;
    struct Reference {
        explicit Reference(const CheckedCurve& P);
        CheckedCurve checked;
        PackedCurve packed;
    };
    struct Other {
        explicit Other(const CheckedCurve& Q);
        CheckedCurve checked;
        PackedCurve packed;
    };

    explicit TableMeasure(const TableOptions& options) : options_(options) {}
    const Requirements& needs() const noexcept { return options_.needs; }
    // Throws where no pair of curves of n and m points has a value.
    void check_sizes(std::ptrdiff_t n, std::ptrdiff_t m) const { options_.check_window(n, m); }
    void check_reference(const Reference& /*P*/) const noexcept {}
    // The work of a curve of n points against `count` curves of `points` points in all.
    static std::int64_t steps(std::int64_t n, std::int64_t /*count*/,
                              std::int64_t points) noexcept {
        return n * points;
    }
    double operator()(const Reference& P, const Other& Q, const PairCall& call) const;

   private:
    TableOptions options_;
};

// Measures of two curves in the plane, in time linear in their points.
class PlanarMeasure {
   public:
    static constexpr bool is_swept = false;
    explicit PlanarMeasure(const char* name) noexcept : needs_{name, 2, true} {}
    const Requirements& needs() const noexcept { return needs_; }
    void check_sizes(std::ptrdiff_t /*n*/, std::ptrdiff_t /*m*/) const noexcept {}
    static std::int64_t steps(std::int64_t n, std::int64_t count, std::int64_t points) noexcept {
        return n * count + points;
    }

    template <class Reference>
    void check_reference(const Reference& /*P*/) const noexcept {}

   private:
    Requirements needs_;
};

class AreaMeasure : public PlanarMeasure {
   public:
    struct Side {
        explicit Side(CheckedCurve curve) : checked(std::move(curve)) {}
        CheckedCurve checked;
    };
    using Reference = Side;
    using Other = Side;

    explicit AreaMeasure(const AreaOptions& options) : PlanarMeasure("area"), options_(options) {}
    double operator()(const Reference& P, const Other& Q, const PairCall& call) const;

   private:
    AreaOptions options_;
};

class PcmMeasure : public PlanarMeasure {
   public:
    struct Reference {
        explicit Reference(const CheckedCurve& P);
        CheckedCurve checked;
        Box box;
        ArcCurve scaled;  // by its own box
    };
    struct Other {
        explicit Other(CheckedCurve Q) : checked(std::move(Q)) {}
        CheckedCurve checked;
    };

    explicit PcmMeasure(const PcmOptions& options);
    double operator()(const Reference& P, const Other& Q, const PairCall& call) const;

   private:
    PcmOptions options_;
};

class CurveLengthMeasure : public PlanarMeasure {
   public:
    struct Side {
        explicit Side(const CheckedCurve& curve);
        CheckedCurve checked;
        std::vector<double> arc_lengths;  // after dividing by its largest |x| and |y|
    };
    using Reference = Side;
    using Other = Side;

    explicit CurveLengthMeasure(const CurveLengthOptions& options)
        : PlanarMeasure("curve_length"), options_(options) {}
    // Throws where there is nothing to divide by.
    void check_reference(const Reference& P) const;
    double operator()(const Reference& P, const Other& Q, const PairCall& call) const;

   private:
    CurveLengthOptions options_;
};

}  // namespace curvewise::detail
