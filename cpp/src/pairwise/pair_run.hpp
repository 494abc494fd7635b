// All pairs of two prepared lists of curves. Threads take tiles of pairs from a common counter.
// Before that, where a few pairs are so large that sharing out whole pairs would leave threads
// idle, each of these is swept by all threads together.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "curvewise/pairwise.hpp"
#include "pairwise/pair_tiles.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::pairwise {

using runtime::Poller;

// Where the value of pair (i, j) goes.
class PairDestination {
   public:
    enum class Shape { matrix, mirrored, condensed };

    PairDestination(double* out, std::size_t columns, Shape shape) noexcept
        : out_(out), columns_(static_cast<std::ptrdiff_t>(columns)), shape_(shape) {}

    // For pairs counted from this row and this column on.
    PairDestination from(std::size_t row, std::size_t column) const noexcept {
        PairDestination result = *this;
        result.row_ = static_cast<std::ptrdiff_t>(row);
        result.column_ = static_cast<std::ptrdiff_t>(column);
        return result;
    }
    bool is_mirrored() const noexcept { return shape_ == Shape::mirrored; }
    void write(std::ptrdiff_t i, std::ptrdiff_t j, double value) const noexcept {
        i += row_;
        j += column_;
        if (shape_ == Shape::condensed) {
            out_[i * columns_ - i * (i + 1) / 2 + j - i - 1] = value;
            return;
        }
        out_[i * columns_ + j] = value;
        if (shape_ == Shape::mirrored) out_[j * columns_ + i] = value;
    }

   private:
    double* out_;
    std::ptrdiff_t columns_;
    Shape shape_;
    std::ptrdiff_t row_ = 0;
    std::ptrdiff_t column_ = 0;
};

// What one thread keeps from one pair to the next.
class ThreadMemory : public runtime::InScratch {
   public:
    ThreadMemory() = default;
    ThreadMemory(const ThreadMemory&) = delete;
    ThreadMemory(ThreadMemory&&) = delete;
    ThreadMemory& operator=(const ThreadMemory&) = delete;
    ThreadMemory& operator=(ThreadMemory&&) = delete;
    virtual ~ThreadMemory() = default;
};

// How a pair is computed.
struct PairCall {
    double cutoff;  // a value above it may come back as any other that is
    std::ptrdiff_t workers;
    Poller& poller;
    ThreadMemory& memory;
};

// The pairs of prepared rows and columns, for any measure.
class PairValues : public runtime::InScratch {
   public:
    PairValues() = default;
    PairValues(const PairValues&) = delete;
    PairValues(PairValues&&) = delete;
    PairValues& operator=(const PairValues&) = delete;
    PairValues& operator=(PairValues&&) = delete;
    virtual ~PairValues() = default;

    virtual bool is_swept() const noexcept = 0;
    virtual PairTiles::Steps steps() const noexcept = 0;
    virtual std::ptrdiff_t row_points(std::ptrdiff_t i) const noexcept = 0;
    virtual std::ptrdiff_t column_points(std::ptrdiff_t j) const noexcept = 0;
    virtual std::unique_ptr<ThreadMemory> make_memory() const = 0;
    // Whether bounds are tested before a value is computed. Their query is made for a row, so that
    // it serves if the next pair has this row, too.
    virtual bool are_bounded() const noexcept = 0;
    virtual double value(std::ptrdiff_t i, std::ptrdiff_t j, const PairCall& call) const = 0;

    // One row with several columns at once, with the same values: how many columns of m points at
    // most, with rows of n points; 1 where such pairs are computed one by one.
    virtual std::ptrdiff_t most_beside(std::ptrdiff_t n, std::ptrdiff_t m) const noexcept = 0;
    // Takes the first of these columns, the longest first, and returns how many; or none.
    virtual std::ptrdiff_t gather(const std::ptrdiff_t* columns, std::ptrdiff_t count,
                                  const PairCall& call) const = 0;
    // Writes the values of row i and the columns taken, from number `first` on, regardless of the
    // cutoff. False, and nothing done, where the row is not for this.
    virtual bool values(std::ptrdiff_t i, std::ptrdiff_t first, double* out,
                        const PairCall& call) const = 0;
    // Writes the places, counted from number `first` of the columns taken, of those whose values
    // with row i may be within the cutoff. Returns their number, and counts the steps of the other
    // pairs; or -1, if it is faster to compute the values of all. `saved` is the time that is
    // saved, divided by the time of the bounds, at least 0.
    virtual std::ptrdiff_t candidates(std::ptrdiff_t i, std::ptrdiff_t first,
                                      std::ptrdiff_t* places, double& saved,
                                      const PairCall& call) const = 0;
    // Several pairs at once, regardless of the cutoff: rows with the same number of points, columns
    // with the same number of points. False, and nothing done, where they are not for this.
    virtual bool pair_values(const std::pair<std::ptrdiff_t, std::ptrdiff_t>* pairs,
                             std::ptrdiff_t count, double* out, const PairCall& call) const = 0;
};

// Throws Stopped where the poller, which has begun, says so.
void run_pairs(const PairValues& pairs, const PairTiles& tiles, const PairDestination& destination,
               const BatchOptions& options, Poller& poller);

}  // namespace curvewise::pairwise
