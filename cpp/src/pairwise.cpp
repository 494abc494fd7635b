// Batches: every list is checked and prepared, curve by curve, for one measure; pair_run.hpp does
// the rest.
#include "curvewise/pairwise.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "pair_measures.hpp"
#include "pair_run.hpp"
#include "pair_tiles.hpp"
#include "watch.hpp"

namespace curvewise {
namespace {

using detail::AreaMeasure;
using detail::CheckedCurve;
using detail::CurveLengthMeasure;
using detail::PairDestination;
using detail::PairSet;
using detail::PairTiles;
using detail::PcmMeasure;
using detail::Sizes;
using detail::TableMeasure;
using detail::TableOptions;
using detail::Watch;

constexpr double infinity = std::numeric_limits<double>::infinity();

TableMeasure measure_of(const DtwOptions& options) { return TableMeasure(TableOptions(options)); }
TableMeasure measure_of(const FrechetOptions& options) {
    return TableMeasure(TableOptions(options));
}
AreaMeasure measure_of(const AreaOptions& options) { return AreaMeasure(options); }
PcmMeasure measure_of(const PcmOptions& options) { return PcmMeasure(options); }
CurveLengthMeasure measure_of(const CurveLengthOptions& options) {
    return CurveLengthMeasure(options);
}

// A list of curves with the name that messages give it.
struct CurveList {
    const std::vector<CurveView>& curves;
    const char* name;

    std::string name_of(std::size_t i) const {
        return std::string(name) + "[" + std::to_string(i) + "]";
    }
};

// A curve checked by itself.
CheckedCurve checked(const CurveView& curve, const std::string& name,
                     const detail::Requirements& needs) {
    detail::check_shape(curve, name.c_str(), needs);
    return {curve, detail::check_finite(curve, name.c_str()), name};
}

// Each checked by itself, and against `first`, of which the others must have the dimension.
std::vector<CheckedCurve> checked(const CurveList& list, const CurveView& first,
                                  const std::string& first_name,
                                  const detail::Requirements& needs) {
    std::vector<CheckedCurve> result;
    result.reserve(list.curves.size());
    for (std::size_t i = 0; i < list.curves.size(); ++i) {
        const std::string name = list.name_of(i);
        detail::check_same_dim(first, first_name.c_str(), list.curves[i], name.c_str());
        result.push_back(checked(list.curves[i], name, needs));
    }
    return result;
}

std::vector<CheckedCurve> checked(const CurveList& list, const CurveList& like,
                                  const detail::Requirements& needs) {
    return checked(list, like.curves[0], like.name_of(0), needs);
}

template <class Side>
std::vector<Side> sides(const std::vector<CheckedCurve>& curves) {
    std::vector<Side> result;
    result.reserve(curves.size());
    for (const CheckedCurve& curve : curves) result.emplace_back(curve);
    return result;
}

template <class M>
std::vector<typename M::Reference> references(const M& measure,
                                              const std::vector<CheckedCurve>& curves) {
    auto result = sides<typename M::Reference>(curves);
    for (const auto& reference : result) measure.check_reference(reference);
    return result;
}

Sizes sizes_of(const std::vector<CurveView>& curves) {
    Sizes sizes;
    sizes.reserve(curves.size());
    for (const CurveView& curve : curves) sizes.push_back(curve.size());
    return sizes;
}

// Of each size once.
Sizes distinct(Sizes sizes) {
    std::sort(sizes.begin(), sizes.end());
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    return sizes;
}

template <class M>
void check_sizes(const M& measure, const Sizes& rows, const Sizes& columns) {
    for (const std::ptrdiff_t n : distinct(rows)) {
        for (const std::ptrdiff_t m : distinct(columns)) measure.check_sizes(n, m);
    }
}

void check_options(const BatchOptions& options) {
    detail::resolve_workers(options.workers);
    if (!(options.cutoff >= 0.0)) {
        throw std::invalid_argument("cutoff is " + std::to_string(options.cutoff) +
                                    "; give a number >= 0");
    }
}

template <class M>
void run_pairs(const M& measure, const std::vector<typename M::Reference>& rows,
               const std::vector<typename M::Other>& columns, const PairTiles& tiles,
               const PairDestination& destination, const BatchOptions& options, Control* control) {
    Watch watch(control);
    watch.begin(tiles.total());
    detail::PairRun<M>(measure, rows, columns, tiles, destination, options).run(watch);
    watch.finish();
}

// Every curve of one list with every curve of the other.
template <class M>
void run_rectangle(const M& measure, const CurveList& XA, const CurveList& XB,
                   const PairDestination& destination, const BatchOptions& options,
                   Control* control) {
    if (XA.curves.empty() || XB.curves.empty()) return;
    const auto rows = references(measure, checked(XA, XA, measure.needs()));
    const auto columns = sides<typename M::Other>(checked(XB, XA, measure.needs()));
    const Sizes row_sizes = sizes_of(XA.curves), column_sizes = sizes_of(XB.curves);
    check_sizes(measure, row_sizes, column_sizes);
    const PairTiles tiles(row_sizes, column_sizes, PairSet::rectangle, M::steps,
                          detail::resolve_workers(options.workers));
    run_pairs(measure, rows, columns, tiles, destination, options, control);
}

// Every two curves of one list.
template <class M>
void run_triangle(const M& measure, const CurveList& X, const PairDestination& destination,
                  const BatchOptions& options, Control* control) {
    if (X.curves.empty()) return;
    const std::vector<CheckedCurve> curves = checked(X, X, measure.needs());
    const auto rows = references(measure, curves);
    const auto columns = sides<typename M::Other>(curves);
    const Sizes sizes = sizes_of(X.curves);
    check_sizes(measure, sizes, sizes);
    const PairTiles tiles(sizes, sizes, PairSet::triangle, M::steps,
                          detail::resolve_workers(options.workers));
    run_pairs(measure, rows, columns, tiles, destination, options, control);
}

}  // namespace

bool is_symmetric(const Measure& measure) noexcept {
    if (const auto* dtw = std::get_if<DtwOptions>(&measure)) {
        return !dtw->open_begin && !dtw->open_end;
    }
    if (const auto* area = std::get_if<AreaOptions>(&measure)) {
        return area->spacing != Spacing::arc_length;
    }
    return std::holds_alternative<FrechetOptions>(measure);
}

void cdist(const std::vector<CurveView>& XA, const std::vector<CurveView>& XB,
           const Measure& measure, double* out, const BatchOptions& options, Control* control) {
    check_options(options);
    const PairDestination destination(out, XB.size(), PairDestination::Shape::matrix);
    std::visit(
        [&](const auto& chosen) {
            run_rectangle(measure_of(chosen), {XA, "XA"}, {XB, "XB"}, destination, options,
                          control);
        },
        measure);
}

void cdist(const std::vector<CurveView>& X, const Measure& measure, double* out,
           const BatchOptions& options, Control* control) {
    check_options(options);
    const CurveList list{X, "XA"};
    std::visit(
        [&](const auto& chosen) {
            if (is_symmetric(measure)) {
                for (std::size_t i = 0; i < X.size(); ++i) out[i * X.size() + i] = 0.0;
                const PairDestination mirrored(out, X.size(), PairDestination::Shape::mirrored);
                run_triangle(measure_of(chosen), list, mirrored, options, control);
            } else {
                const PairDestination matrix(out, X.size(), PairDestination::Shape::matrix);
                run_rectangle(measure_of(chosen), list, list, matrix, options, control);
            }
        },
        measure);
}

void pdist(const std::vector<CurveView>& X, const Measure& measure, double* out,
           const BatchOptions& options, Control* control) {
    if (!is_symmetric(measure)) {
        throw std::invalid_argument(
            "pdist needs a measure for which d(P, Q) = d(Q, P), which this one with these options "
            "is not; use cdist");
    }
    check_options(options);
    const PairDestination condensed(out, X.size(), PairDestination::Shape::condensed);
    std::visit(
        [&](const auto& chosen) {
            run_triangle(measure_of(chosen), {X, "X"}, condensed, options, control);
        },
        measure);
}

class Prepared::State {
   public:
    State() = default;
    State(const State&) = delete;
    State(State&&) = delete;
    State& operator=(const State&) = delete;
    State& operator=(State&&) = delete;
    virtual ~State() = default;
    virtual double value(const CurveView& Q, Control* control) const = 0;
    virtual void values(const std::vector<CurveView>& Qs, double* out, const BatchOptions& options,
                        Control* control) const = 0;
};

namespace {

// Row by row.
std::vector<double> contiguous(const CurveView& curve) {
    std::vector<double> copy;
    copy.reserve(static_cast<std::size_t>(curve.size() * curve.dim()));
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) copy.push_back(curve(i, c));
    }
    return copy;
}

template <class M>
class PreparedMeasure final : public Prepared::State {
   public:
    PreparedMeasure(const CurveView& P, const M& measure)
        : measure_(measure),
          points_((detail::check_shape(P, "P", measure.needs()), contiguous(P))),
          P_(P.is_flat() ? CurveView(points_.data(), P.size(), 1, 1, 0)
                         : CurveView(points_.data(), P.size(), P.dim())),
          rows_(references(measure, {checked(P_, "P", measure.needs())})) {}

    double value(const CurveView& Q, Control* control) const override {
        detail::check_same_dim(P_, "P", Q, "Q");
        const typename M::Other other(checked(Q, "Q", measure_.needs()));
        measure_.check_sizes(P_.size(), Q.size());
        Watch watch(control);
        watch.begin(M::steps(P_.size(), 1, Q.size()));
        detail::SweepMemory memory;
        const double value = measure_(rows_[0], other, {infinity, 1, watch, memory});
        watch.finish();
        return value;
    }

    void values(const std::vector<CurveView>& Qs, double* out, const BatchOptions& options,
                Control* control) const override {
        if (Qs.empty()) return;
        const CurveList list{Qs, "Q"};
        const auto columns = sides<typename M::Other>(checked(list, P_, "P", measure_.needs()));
        const Sizes row_size{P_.size()}, column_sizes = sizes_of(Qs);
        check_sizes(measure_, row_size, column_sizes);
        const PairTiles tiles(row_size, column_sizes, PairSet::rectangle, M::steps,
                              detail::resolve_workers(options.workers));
        const PairDestination destination(out, columns.size(), PairDestination::Shape::matrix);
        run_pairs(measure_, rows_, columns, tiles, destination, options, control);
    }

   private:
    M measure_;
    std::vector<double> points_;
    CurveView P_;
    std::vector<typename M::Reference> rows_;
};

}  // namespace

Prepared::Prepared(const CurveView& P, const Measure& measure)
    : state_(std::visit(
          [&](const auto& options) -> std::shared_ptr<const State> {
              using M = decltype(measure_of(options));
              return std::make_shared<PreparedMeasure<M>>(P, measure_of(options));
          },
          measure)) {}

double Prepared::operator()(const CurveView& Q, Control* control) const {
    return state_->value(Q, control);
}

void Prepared::operator()(const std::vector<CurveView>& Qs, double* out,
                          const BatchOptions& options, Control* control) const {
    check_options(options);
    state_->values(Qs, out, options, control);
}

}  // namespace curvewise
