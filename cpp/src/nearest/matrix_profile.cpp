// The matrix profile (see curvewise/matrix_profile.hpp).
//
// Let p be the product of two centred windows of L points. Their squared distance is 2 L (size_i +
// size_j - score), where a size is half the number of coordinates that vary in a window, and the
// score is the sum of p / (L deviation_i deviation_j) over the coordinates. The error of p is
// bounded by tile: that of its first row, and of B updates by half differences and sums of
// differences from the means (whose own error is at most L X eps, X the largest number). A score
// is at least of interest if it could reach that of the nearest so far, after all rounding of the
// definition is added.
#include "curvewise/matrix_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

#include "curves/checks.hpp"
#include "runtime/aligned_buffer.hpp"
#include "runtime/scratch.hpp"
#include "runtime/workers.hpp"
#include "warping/dispatch.hpp"

namespace curvewise {
namespace nearest {
namespace {

using runtime::AlignedBuffer;
using runtime::Poller;

constexpr double no_distance = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();
// Tiles with smaller deviations are computed by the definition: their scores could overflow.
constexpr double least_deviation = 1e-100;
constexpr double underflow = 1e-300;

// The largest magnitudes of one coordinate of the windows of a block.
struct Magnitudes {
    double half = 0.0, sum = 0.0, number = 0.0, deviation = 0.0;
    double least_deviation = no_distance;  // of those that vary

    void take(const Magnitudes& other) noexcept {
        half = std::max(half, other.half);
        sum = std::max(sum, other.sum);
        number = std::max(number, other.number);
        deviation = std::max(deviation, other.deviation);
        least_deviation = std::min(least_deviation, other.least_deviation);
    }
};

// The windows of a record, by coordinate.
class Windows {
   public:
    Windows(const CurveView& record, const CurveView& means, const CurveView& deviations,
            std::ptrdiff_t room)
        : count(means.size()),
          length(record.size() - count + 1),
          dim(record.dim()),
          rows(std::max<std::ptrdiff_t>(256, 4 * length)),
          stride(AlignedBuffer::rounded(record.size() + room)),
          tolerance(epsilon * static_cast<double>(16 * dim * (length * dim + 16))),
          points_(dim * stride),
          means_(dim * stride),
          deviations_(dim * stride),
          halves_(dim * stride),
          sums_(dim * stride),
          scales_(dim * stride),
          sizes_(stride) {
        for (AlignedBuffer* buffer :
             {&points_, &means_, &deviations_, &halves_, &sums_, &scales_}) {
            std::fill_n(buffer->data(), dim * stride, 0.0);
        }
        std::fill_n(sizes_.data(), count, 0.0);
        std::fill_n(sizes_.data() + count, stride - count, no_distance);
        blocks_.resize(static_cast<std::size_t>(dim * blocks()));
        for (std::ptrdiff_t c = 0; c < dim; ++c) read(record, means, deviations, c);
    }

    // The squared distance of two windows, or a number above `most`, which it then exceeds.
    double squared_distance(std::ptrdiff_t i, std::ptrdiff_t j, double most) const noexcept {
        double total = 0.0;
        for (std::ptrdiff_t t = 0; t < length; ++t) {
            double square = 0.0;
            for (std::ptrdiff_t c = 0; c < dim; ++c) {
                const double difference =
                    normalized(c * stride, i, t) - normalized(c * stride, j, t);
                square += difference * difference;
            }
            total += square;
            if (total > most) break;
        }
        return total;
    }

    // The products of window i and some windows from j on, at [c * lanes + lane].
    void multiply(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t lanes,
                  double* products) const noexcept {
        std::fill_n(products, dim * lanes, 0.0);
        for (std::ptrdiff_t c = 0; c < dim; ++c, products += lanes) {
            const double* const x = points_.data() + c * stride;
            const double* const mean = means_.data() + c * stride;
            for (std::ptrdiff_t t = 0; t < length; ++t) {
                const double factor = x[i + t] - mean[i];
                for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
                    products[lane] += factor * (x[j + lane + t] - mean[j + lane]);
                }
            }
        }
    }

    // What a product of coordinate c may be wrong by, in the tile of a block of rows with columns
    // from `first` to `last`; infinite where the scores are not to be relied on.
    double slack(std::ptrdiff_t c, std::ptrdiff_t block, std::ptrdiff_t first,
                 std::ptrdiff_t last) const noexcept {
        const Magnitudes* const all = blocks_.data() + c * blocks();
        const Magnitudes& a = all[block];
        Magnitudes b;
        for (std::ptrdiff_t k = first / rows; k <= std::min(last, count - 1) / rows; ++k) {
            b.take(all[k]);
        }
        if (std::min(a.least_deviation, b.least_deviation) < least_deviation) return no_distance;
        const auto n = static_cast<double>(length), steps = static_cast<double>(rows);
        const double of_mean = (n + 32.0) * epsilon;
        const double product = n * a.deviation * b.deviation;
        const double of_steps = a.half * b.sum + b.half * a.sum;
        const double of_means = of_mean * (a.half * b.number + b.half * a.number);
        return 2.0 * ((n + steps) * epsilon * product +
                      steps * (4.0 * epsilon * of_steps + of_means) +
                      n * of_mean * a.number * of_mean * b.number) +
               underflow;
    }

    // Halves, sums, scales and sizes for the kernel.
    kernels::Diagonals for_kernel() const noexcept {
        return {
            halves_.data(), sums_.data(), scales_.data(), stride, dim, sizes_.data(), nullptr, 0,
            nullptr,        nullptr};
    }

    std::ptrdiff_t blocks() const noexcept { return (count + rows - 1) / rows; }

    const std::ptrdiff_t count, length, dim;
    const std::ptrdiff_t rows;  // of a block
    const std::ptrdiff_t stride;
    // The rounding of scores and of the definition's distances.
    const double tolerance;

   private:
    double normalized(std::ptrdiff_t at, std::ptrdiff_t i, std::ptrdiff_t t) const noexcept {
        const double deviation = deviations_.data()[at + i];
        if (deviation == 0.0) return 0.0;
        return (points_.data()[at + i + t] - means_.data()[at + i]) / deviation;
    }

    void read(const CurveView& record, const CurveView& means, const CurveView& deviations,
              std::ptrdiff_t c) {
        double* const x = points_.data() + c * stride;
        double* const mean = means_.data() + c * stride;
        for (std::ptrdiff_t i = 0; i < record.size(); ++i) x[i] = record(i, c);
        const auto n = static_cast<double>(length);
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const std::ptrdiff_t at = c * stride + i;
            Magnitudes own;
            mean[i] = means(i, c);
            const double deviation = deviations_.data()[at] = deviations(i, c);
            if (deviation != 0.0) {
                scales_.data()[at] = 1.0 / (deviation * std::sqrt(n));
                sizes_.data()[i] += 0.5;
                own.deviation = own.least_deviation = deviation;
            }
            if (i > 0) {
                const double in = x[i + length - 1], out = x[i - 1];
                halves_.data()[at] = 0.5 * (in - out);
                sums_.data()[at] = (in - mean[i]) + (out - mean[i - 1]);
                own.half = std::abs(halves_.data()[at]);
                own.sum = std::abs(sums_.data()[at]);
                own.number = std::abs(out);
            }
            Magnitudes& block = blocks_[static_cast<std::size_t>(c * blocks() + i / rows)];
            block.take(own);
        }
        for (std::ptrdiff_t b = 0; b < blocks(); ++b) {
            Magnitudes& block = blocks_[static_cast<std::size_t>(c * blocks() + b)];
            const std::ptrdiff_t end = std::min((b + 1) * rows, count) + length - 1;
            for (std::ptrdiff_t i = b * rows; i < end; ++i) {
                block.number = std::max(block.number, std::abs(x[i]));
            }
        }
    }

    AlignedBuffer points_, means_, deviations_, halves_, sums_, scales_;
    AlignedBuffer sizes_;
    runtime::ScratchVector<Magnitudes> blocks_;  // by coordinate
};

struct Nearest {
    double square = no_distance;
    std::ptrdiff_t index = std::numeric_limits<std::ptrdiff_t>::max();

    bool is_improved_by(double other, std::ptrdiff_t its_index) const noexcept {
        return other < square || (other == square && its_index < index);
    }
};

// One thread's search: diagonals one after the other, and the nearest in these.
class DiagonalSearch {
   public:
    DiagonalSearch(const Windows& windows, std::ptrdiff_t lanes, Poller& poller)
        : windows_(windows),
          lanes_(lanes),
          poller_(poller),
          limits_(windows.stride),
          products_(windows.dim * lanes),
          slacks_(windows.dim),
          all_(windows.for_kernel()),
          found_(static_cast<std::size_t>(windows.count)) {
        std::fill_n(limits_.data(), windows.count, -no_distance);
        std::fill_n(limits_.data() + windows.count, windows.stride - windows.count, no_distance);
        all_.limits = limits_.data();
        all_.products = products_.data();
        all_.slacks = slacks_.data();
    }

    // The diagonals from `offset` on, in tiles of a block of rows.
    void search(std::ptrdiff_t offset) {
        const auto scan = warping::active_level().kernels->scan_diagonals;
        all_.offset = offset;
        const std::ptrdiff_t end = windows_.count - offset;
        for (std::ptrdiff_t first = 0; first < end; first += windows_.rows) {
            const std::ptrdiff_t last = std::min(first + windows_.rows, end);
            bool is_known = true;
            for (std::ptrdiff_t c = 0; c < windows_.dim; ++c) {
                slacks_.data()[c] = windows_.slack(c, first / windows_.rows, first + offset,
                                                   last + offset + lanes_ - 2);
                is_known = is_known && std::isfinite(slacks_.data()[c]);
            }
            windows_.multiply(first, first + offset, lanes_, products_.data());
            look_at(first);
            for (std::ptrdiff_t row = first + 1; row < last; ++row) {
                if (is_known) row = scan(all_, row, last);
                if (row < last) look_at(row);
            }
            if (poller_.count_steps((last - first) * lanes_)) throw Stopped();
        }
    }

    const runtime::ScratchVector<Nearest>& found() const noexcept { return found_; }

   private:
    // Computes the pairs of a row whose scores may reach a limit.
    void look_at(std::ptrdiff_t i) {
        const std::ptrdiff_t first = i + all_.offset;
        const std::ptrdiff_t last = std::min(first + lanes_, windows_.count);
        for (std::ptrdiff_t j = first; j < last; ++j) {
            const double score = this->score(i, j, j - first);
            const bool is_near_i = may_improve(i, j, score - all_.sizes[j]);
            const bool is_near_j = may_improve(j, i, score - all_.sizes[i]);
            if (!is_near_i && !is_near_j) continue;
            const double most =
                std::max(is_near_i ? found_[static_cast<std::size_t>(i)].square : 0.0,
                         is_near_j ? found_[static_cast<std::size_t>(j)].square : 0.0);
            const double square = windows_.squared_distance(i, j, most);
            if (square > most) continue;
            improve(i, j, square);
            improve(j, i, square);
            poller_.spend(windows_.length);
        }
    }

    double score(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t lane) const noexcept {
        double sum = 0.0;
        for (std::ptrdiff_t c = 0; c < windows_.dim; ++c) {
            const std::ptrdiff_t at = c * windows_.stride;
            sum += (all_.products[c * lanes_ + lane] + all_.slacks[c]) * all_.scales[at + i] *
                   all_.scales[at + j];
        }
        return sum;
    }

    // Also where the score is nan.
    bool may_improve(std::ptrdiff_t i, std::ptrdiff_t j, double score) const noexcept {
        return !(score < limits_.data()[i]) &&
               found_[static_cast<std::size_t>(i)].is_improved_by(0.0, j);
    }

    void improve(std::ptrdiff_t i, std::ptrdiff_t j, double square) noexcept {
        if (!found_[static_cast<std::size_t>(i)].is_improved_by(square, j)) return;
        found_[static_cast<std::size_t>(i)] = {square, j};
        limits_.data()[i] =
            all_.sizes[i] - square / static_cast<double>(2 * windows_.length) - windows_.tolerance;
    }

    const Windows& windows_;
    std::ptrdiff_t lanes_;
    Poller& poller_;
    AlignedBuffer limits_, products_, slacks_;
    kernels::Diagonals all_;
    runtime::ScratchVector<Nearest> found_;
};

// A thread's search, which shares its answers when it ends.
class SharedSearch {
   public:
    SharedSearch(const Windows& windows, std::ptrdiff_t lanes, Poller& poller, std::mutex& mutex,
                 runtime::ScratchVector<Nearest>& best)
        : search_(windows, lanes, poller), mutex_(mutex), best_(best) {}
    SharedSearch(const SharedSearch&) = delete;
    SharedSearch(SharedSearch&&) = delete;
    SharedSearch& operator=(const SharedSearch&) = delete;
    SharedSearch& operator=(SharedSearch&&) = delete;
    ~SharedSearch() {
        const std::lock_guard<std::mutex> lock(mutex_);
        for (std::size_t i = 0; i < best_.size(); ++i) {
            const Nearest& found = search_.found()[i];
            if (best_[i].is_improved_by(found.square, found.index)) best_[i] = found;
        }
    }
    void search(std::ptrdiff_t offset) { search_.search(offset); }

   private:
    DiagonalSearch search_;
    std::mutex& mutex_;
    runtime::ScratchVector<Nearest>& best_;
};

void check(const CurveView& record, const CurveView& means, const CurveView& deviations,
           std::ptrdiff_t exclusion, Poller& poller) {
    constexpr WholeNumberRange exclusion_range{0, "give a whole number >= 0"};
    const std::ptrdiff_t count = means.size();
    if (count < 1 || count > record.size() || deviations.size() != count || record.dim() < 1 ||
        means.dim() != record.dim() || deviations.dim() != record.dim()) {
        throw std::invalid_argument("record, means and deviations have shapes " +
                                    curves::shape_of(record) + ", " + curves::shape_of(means) +
                                    " and " + curves::shape_of(deviations) +
                                    "; give a mean and a deviation of each window");
    }
    curves::check_whole_number("exclusion", exclusion, exclusion_range);
    curves::CheckedCurve(record, "record", poller);
    curves::CheckedCurve(means, "means", poller);
    curves::CheckedCurve(deviations, "deviations", poller);
}

}  // namespace
}  // namespace nearest

MatrixProfile matrix_profile(const CurveView& record, const CurveView& means,
                             const CurveView& deviations, std::ptrdiff_t exclusion,
                             std::ptrdiff_t workers, Control* control) {
    using nearest::Nearest;
    using nearest::SharedSearch;
    runtime::Poller poller(control);
    nearest::check(record, means, deviations, exclusion, poller);
    const std::ptrdiff_t threads = runtime::resolve_workers(workers);
    const std::ptrdiff_t lanes = kernels::diagonals_a_lane * warping::active_level().kernels->lanes;
    const nearest::Windows windows(record, means, deviations, lanes);
    const std::ptrdiff_t first = std::min(exclusion, windows.count - 1) + 1;
    const std::ptrdiff_t diagonals = windows.count - first;
    const std::ptrdiff_t items = (diagonals + lanes - 1) / lanes;
    poller.begin(lanes * (items * diagonals - items * (items - 1) / 2 * lanes));
    runtime::ScratchVector<Nearest> best(static_cast<std::size_t>(windows.count));
    std::mutex mutex;
    runtime::for_each(static_cast<std::size_t>(items), threads, poller, [&](runtime::Poller& own) {
        const auto search = std::make_shared<SharedSearch>(windows, lanes, own, mutex, best);
        return [=](std::size_t item) {
            search->search(first + static_cast<std::ptrdiff_t>(item) * lanes);
        };
    });
    poller.finish();
    MatrixProfile profile;
    for (const Nearest& one : best) {
        const bool is_there = one.square != nearest::no_distance;
        profile.distances.push_back(std::sqrt(one.square));
        profile.indices.push_back(is_there ? one.index : -1);
    }
    return profile;
}

}  // namespace curvewise
