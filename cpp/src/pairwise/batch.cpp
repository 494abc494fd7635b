#include "pairwise/batch.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/scratch.hpp"
#include "runtime/workers.hpp"

namespace curvewise::pairwise {
namespace {

using CheckedCurves = runtime::ScratchVector<CheckedCurve>;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Longer lists are cut into blocks, so that the prepared curves (in doubles, packed, with boxes)
// take at most about 100 MB at a time. A block's curves are prepared once for each block of the
// other list. That takes negligible time compared with its pairs.
constexpr std::ptrdiff_t numbers_in_a_block = std::ptrdiff_t{1} << 21;

struct Block {
    std::size_t first;
    std::size_t end;
};

// With two curves a thread at least, so that all have pairs to compute.
runtime::ScratchVector<Block> blocks_of(const CheckedCurves& list, std::ptrdiff_t workers) {
    const auto fewest = 2 * static_cast<std::size_t>(workers);
    runtime::ScratchVector<Block> blocks{{0, 0}};
    std::ptrdiff_t numbers = 0;
    for (const CheckedCurve& checked : list) {
        Block& last = blocks.back();
        if (numbers >= numbers_in_a_block && last.end - last.first >= fewest) {
            blocks.push_back({last.end, last.end});
            numbers = 0;
        }
        ++blocks.back().end;
        numbers += checked.curve.size() * checked.curve.dim();
    }
    return blocks;
}

// The curves of a block, in doubles.
class LoadedBlock {
   public:
    LoadedBlock(const CheckedCurves& all, const Block& block, Poller& poller) : curves_(&all) {
        const bool is_all = block.end - block.first == all.size();
        if (is_all && std::none_of(all.begin(), all.end(), has_floats)) return;
        own_.reserve(block.end - block.first);
        points_.reserve(block.end - block.first);
        for (std::size_t i = block.first; i < block.end; ++i) {
            points_.emplace_back(all[i].curve, poller);
            own_.push_back(all[i]);
            own_.back().curve = points_.back().view();
        }
        curves_ = &own_;
    }
    LoadedBlock(const LoadedBlock&) = delete;
    LoadedBlock(LoadedBlock&&) = delete;
    LoadedBlock& operator=(const LoadedBlock&) = delete;
    LoadedBlock& operator=(LoadedBlock&&) = delete;
    ~LoadedBlock() = default;

    const CheckedCurves& curves() const noexcept { return *curves_; }

   private:
    static bool has_floats(const CheckedCurve& checked) noexcept {
        return checked.curve.has_floats();
    }

    const CheckedCurves* curves_;
    CheckedCurves own_;
    runtime::ScratchVector<curves::CurveInDoubles> points_;
};

// The curves of a list, found finite; their shapes have been checked.
CheckedCurves checked(const BatchMeasure& measure, const CurveList& list, Poller& poller) {
    const bool on_sphere = measure.requirements().on_sphere;
    CheckedCurves result;
    result.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        poller.poll_in_loop(i);
        result.push_back(curves::checked_listed(list[i], list.name_of(i), poller, on_sphere));
    }
    return result;
}

Sizes sizes_of(const CurveList& list) {
    Sizes sizes;
    sizes.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) sizes.push_back(list[i].size());
    return sizes;
}

Sizes sizes_of(const CheckedCurves& list) {
    Sizes sizes;
    sizes.reserve(list.size());
    for (const CheckedCurve& checked : list) sizes.push_back(checked.curve.size());
    return sizes;
}

// Each size once.
Sizes distinct(const CheckedCurves& curves) {
    Sizes sizes = sizes_of(curves);
    std::sort(sizes.begin(), sizes.end());
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    return sizes;
}

void check_sizes(const BatchMeasure& measure, const CheckedCurves& P, const CheckedCurves& Q) {
    const Sizes columns = distinct(Q);
    for (const std::ptrdiff_t n : distinct(P)) {
        for (const std::ptrdiff_t m : columns) measure.check_sizes(n, m);
    }
}

void check_columns(const BatchMeasure& measure, const BatchMeasure::Rows& rows,
                   const CheckedCurves& Q, const runtime::ScratchVector<Block>& blocks,
                   Poller& poller) {
    for (const Block& block : blocks) {
        const LoadedBlock q(Q, block, poller);
        measure.pairs(rows, q.curves(), false, poller);
    }
}

// Prepares every curve, block by block, and throws the errors of the preparation.
void check_prepared(const BatchMeasure& measure, const CheckedCurves& P,
                    const runtime::ScratchVector<Block>& rows_of, const CheckedCurves& Q,
                    const runtime::ScratchVector<Block>& columns_of, Poller& poller) {
    for (const Block& block : rows_of) {
        const LoadedBlock p(P, block, poller);
        const auto rows = measure.prepare_rows(p.curves(), poller);
        if (block.first == 0) check_columns(measure, *rows, Q, columns_of, poller);
        measure.check_rows(*rows, poller);
    }
}

std::ptrdiff_t workers_of(const BatchOutput& output) {
    return runtime::resolve_workers(output.options.workers);
}

struct RowBlock {
    const BatchMeasure::Rows& rows;
    Sizes sizes;
    std::size_t first;
    bool is_checked;
};

// The pairs of prepared rows with all columns, block by block. In a triangle with those from the
// rows' own on.
void compute_rows(const BatchMeasure& measure, const RowBlock& row, const CheckedCurves& Q,
                  const runtime::ScratchVector<Block>& columns_of, PairSet set,
                  const BatchOutput& output, Poller& poller) {
    for (const Block& column : columns_of) {
        if (set == PairSet::triangle && column.first < row.first) continue;
        const bool is_diagonal = set == PairSet::triangle && column.first == row.first;
        const LoadedBlock q(Q, column, poller);
        const bool has_cutoff = output.options.cutoff < infinity;
        const auto pairs = measure.pairs(row.rows, q.curves(), has_cutoff, poller);
        if (!row.is_checked) measure.check_rows(row.rows, poller);
        const Sizes sizes = sizes_of(q.curves());
        const std::ptrdiff_t beside =
            pairs->most_beside(*std::max_element(row.sizes.begin(), row.sizes.end()),
                               *std::max_element(sizes.begin(), sizes.end()));
        const PairTiles tiles(row.sizes, sizes,
                              is_diagonal ? PairSet::triangle : PairSet::rectangle, measure.steps(),
                              workers_of(output), beside);
        run_pairs(*pairs, tiles, output.destination.from(row.first, column.first), output.options,
                  poller);
    }
}

// In a triangle, P is Q.
void compute_all(const BatchMeasure& measure, const CheckedCurves& P, const CheckedCurves& Q,
                 PairSet set, const BatchOutput& output, Poller& poller) {
    check_sizes(measure, P, Q);
    const runtime::ScratchVector<Block> rows_of = blocks_of(P, workers_of(output));
    const runtime::ScratchVector<Block> columns_of = blocks_of(Q, workers_of(output));
    // A single pair of blocks is prepared once, and checked then.
    const bool are_many = rows_of.size() > 1 || columns_of.size() > 1;
    if (are_many) check_prepared(measure, P, rows_of, Q, columns_of, poller);
    for (const Block& block : rows_of) {
        const LoadedBlock p(P, block, poller);
        const auto rows = measure.prepare_rows(p.curves(), poller);
        const RowBlock row{*rows, sizes_of(p.curves()), block.first, are_many};
        compute_rows(measure, row, Q, columns_of, set, output, poller);
    }
    poller.finish();
}

// The diagonal of a matrix whose triangle is computed.
void write_diagonal(const BatchMeasure& measure, const CheckedCurves& curves,
                    const BatchOutput& output, Poller& poller) {
    const bool was_counting = poller.set_counting(false);
    for (std::size_t i = 0; i < curves.size(); ++i) {
        double value = 0.0;
        if (!measure.is_zero_to_itself(curves[i])) {
            const LoadedBlock one(curves, {i, i + 1}, poller);
            const auto row = measure.prepare_rows(one.curves(), poller);
            value = measure.value(*row, one.curves().front(), {}, poller);
        }
        const auto place = static_cast<std::ptrdiff_t>(i);
        output.destination.write(place, place, value > output.options.cutoff ? infinity : value);
    }
    poller.set_counting(was_counting);
}

}  // namespace

void check_batch(const BatchMeasure& measure, const CurveList& XA, const CurveList& XB,
                 Control* control) {
    if (XA.size() == 0 || XB.size() == 0) return;
    check_shapes(measure.requirements(), XA, XB);
    Poller poller(control);
    const CheckedCurves P = checked(measure, XA, poller), Q = checked(measure, XB, poller);
    check_sizes(measure, P, Q);
    check_prepared(measure, P, blocks_of(P, 1), Q, blocks_of(Q, 1), poller);
}

void check_batch(const BatchMeasure& measure, const CurveList& X, Control* control) {
    if (X.size() == 0) return;
    check_shapes(measure.requirements(), X);
    Poller poller(control);
    const CheckedCurves P = checked(measure, X, poller);
    check_sizes(measure, P, P);
    check_prepared(measure, P, blocks_of(P, 1), P, blocks_of(P, 1), poller);
}

void compute_batch(const BatchMeasure& measure, const CurveList& XA, const CurveList& XB,
                   const BatchOutput& output) {
    if (XA.size() == 0 || XB.size() == 0) return;
    check_shapes(measure.requirements(), XA, XB);
    Poller poller(output.control);
    poller.begin(PairTiles::total(sizes_of(XA), sizes_of(XB), PairSet::rectangle, measure.steps()));
    const CheckedCurves P = checked(measure, XA, poller), Q = checked(measure, XB, poller);
    compute_all(measure, P, Q, PairSet::rectangle, output, poller);
}

void compute_batch(const BatchMeasure& measure, const CurveList& X, PairSet set,
                   const BatchOutput& output) {
    if (X.size() == 0) return;
    check_shapes(measure.requirements(), X);
    Poller poller(output.control);
    const Sizes sizes = sizes_of(X);
    poller.begin(PairTiles::total(sizes, sizes, set, measure.steps()));
    const CheckedCurves P = checked(measure, X, poller);
    if (output.destination.is_mirrored()) write_diagonal(measure, P, output, poller);
    compute_all(measure, P, P, set, output, poller);
}

PreparedCurve::PreparedCurve(std::unique_ptr<const BatchMeasure> measure, const CurveView& P,
                             Control* control)
    : PreparedCurve(std::move(measure), P, Poller(control)) {}

PreparedCurve::PreparedCurve(std::unique_ptr<const BatchMeasure> measure, const CurveView& P,
                             Poller&& poller)
    : measure_(std::move(measure)),
      points_((check_shapes(measure_->requirements(), {P, "P"}), curves::OwnedCurve(P, poller))),
      P_(points_.view()),
      rows_(measure_->prepare_rows(checked(*measure_, {P_, "P"}, poller), poller)) {
    measure_->check_rows(*rows_, poller);
}

double PreparedCurve::value(const CurveView& Q, const BatchOptions& options,
                            Control* control) const {
    check_shapes(measure_->requirements(), {P_, "P"}, {Q, "Q"});
    Poller poller(control);
    poller.begin(measure_->steps()(P_.size(), 1, Q.size()));
    const CheckedCurve checked_q(Q, "Q", poller, measure_->requirements().on_sphere);
    measure_->check_sizes(P_.size(), Q.size());
    const double value = measure_->value(*rows_, checked_q, options, poller);
    poller.finish();
    return value > options.cutoff ? infinity : value;
}

void PreparedCurve::values(const CurveList& Qs, const BatchOutput& output) const {
    if (Qs.size() == 0) return;
    check_shapes(measure_->requirements(), {P_, "P"}, Qs);
    Poller poller(output.control);
    poller.begin(
        PairTiles::total({P_.size()}, sizes_of(Qs), PairSet::rectangle, measure_->steps()));
    const CheckedCurves columns = checked(*measure_, Qs, poller);
    for (const std::ptrdiff_t m : distinct(columns)) measure_->check_sizes(P_.size(), m);
    const runtime::ScratchVector<Block> columns_of = blocks_of(columns, workers_of(output));
    if (columns_of.size() > 1) check_columns(*measure_, *rows_, columns, columns_of, poller);
    compute_rows(*measure_, {*rows_, {P_.size()}, 0, true}, columns, columns_of, PairSet::rectangle,
                 output, poller);
    poller.finish();
}

}  // namespace curvewise::pairwise
