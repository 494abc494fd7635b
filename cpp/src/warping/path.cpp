// Divide and conquer. A region's path enters it from one known cell above (or starts in it) and
// ends in its last row at a known column. A small region is swept once with the predecessor of
// every cell, and the path is read off backwards. A larger one is swept in two halves: the upper
// one for the values of its last row, the lower one with, in every cell, the column at which its
// path leaves that row. This gives the cell where the two halves meet; the lower half starts from
// its value.
//
// So every value on the path is computed from the same operands as in the whole table, and is
// bitwise identical. A backward pass (Hirschberg) would not give that. Values off the path can only
// be larger than in the whole table, so every decision on the path is the same. In all, it computes
// twice the cells of a distance, half of them with origins. O(n + m) memory.
#include "warping/path.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "runtime/allocation_error.hpp"
#include "warping/strip_walk.hpp"
#include "warping/sweep.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A part of the problem: the region, how its path comes into it, and where it ends.
struct Part {
    Region region;
    bool starts_here;    // at the whole table's beginning; otherwise
    double value_above;  // the value of the cell above the region's first column
    bool open_end;       // in the first column with the smallest value; otherwise in the last
};

class PathFinder {
   public:
    PathFinder(const SweepProblem& problem, std::ptrdiff_t max_codes)
        : problem_(problem), max_codes_(max_codes) {}

    // Appends the part's path, from its end to its beginning, and returns its last value.
    double find(const Part& part) {
        if (part.region.rows == 1 || codes_of(part.region) <= max_codes_) {
            return read_off(part);
        }
        const std::ptrdiff_t upper_rows = part.region.rows / 2;
        const Meeting meeting = meet(part, upper_rows);
        Part lower = part;
        lower.region.first_row += upper_rows;
        lower.region.rows -= upper_rows;
        lower.region.first_column += meeting.column;
        lower.region.columns = meeting.end_column + 1 - meeting.column;
        lower.starts_here = false;
        lower.value_above = meeting.value;
        lower.open_end = false;
        find(lower);
        Part upper = part;
        upper.region.rows = upper_rows;
        upper.region.columns = meeting.column + 1;
        upper.open_end = false;
        find(upper);
        return meeting.end_value;
    }

    IndexPairs take() {
        std::reverse(path_.begin(), path_.end());
        return std::move(path_);
    }

   private:
    struct Meeting {
        std::ptrdiff_t column;  // at which the path leaves the last of the upper rows
        double value;           // there
        std::ptrdiff_t end_column;
        double end_value;
    };

    // In a table with limited columns, only these columns take codes.
    std::ptrdiff_t codes_of(const Region& region) const {
        const bool is_limited = problem_.columns.is_limited();
        return is_limited ? CodeLayout(problem_, region).size : region.rows * region.columns;
    }

    // In the last row, whose values outside the columns are undefined.
    std::ptrdiff_t end_column(const Part& part, const Row& last_row) const noexcept {
        const Region& region = part.region;
        if (!part.open_end) return region.columns - 1;
        const ColumnRange live = problem_.columns.columns(region.first_row + region.rows - 1);
        const double* const first =
            last_row.data() + std::max<std::ptrdiff_t>(live.first - region.first_column, 0);
        const double* const end =
            last_row.data() + std::min(live.last + 1 - region.first_column, region.columns);
        return std::min_element(first, end) - last_row.data();
    }

    // The row above the part.
    Row entry(const Part& part) const {
        Row row;
        if (part.starts_here) {
            assign_start(problem_, part.region.columns, row);
        } else {
            row.assign(part.region.columns, infinity);
            row[0] = part.value_above;
        }
        return row;
    }

    bool needs_start(const Part& part) const noexcept {
        return part.starts_here && !problem_.open_begin;
    }

    Meeting meet(const Part& part, std::ptrdiff_t upper_rows) const {
        Region half = part.region;
        half.rows = upper_rows;
        const std::ptrdiff_t columns = part.region.columns;
        Row row = entry(part);
        sweep(problem_, half, needs_start(part), row.data(), {});
        Row values(columns, 0.0);
        std::copy_n(row.data(), columns, values.data());
        Row origins(columns, 0.0);
        std::iota(origins.data(), origins.data() + columns, 0.0);
        Destination destination;
        destination.origins = origins.data();
        half.first_row += upper_rows;
        half.rows = part.region.rows - upper_rows;
        sweep(problem_, half, false, row.data(), destination);
        const std::ptrdiff_t end = end_column(part, row);
        const auto column = static_cast<std::ptrdiff_t>(origins[end]);
        return {column, values[column], end, row[end]};
    }

    double read_off(const Part& part) {
        const CodeLayout layout(problem_, part.region);
        const auto codes = runtime::allocate<std::uint8_t>(layout.size, "a table of predecessors");
        Destination destination;
        destination.codes = codes.get();
        destination.layout = layout.strips.data();
        Row row = entry(part);
        sweep(problem_, part.region, needs_start(part), row.data(), destination);

        std::ptrdiff_t i = part.region.rows - 1;
        std::ptrdiff_t j = end_column(part, row);
        const double end_value = row[j];
        const auto code_at = [&]() {
            const StripCodes& strip = layout.strips[static_cast<std::size_t>(i / layout.height)];
            const std::ptrdiff_t lane = i % layout.height;
            const std::ptrdiff_t diagonal = j + lane - strip.first_diagonal;
            return static_cast<kernels::Predecessor>(
                codes[static_cast<std::size_t>(strip.offset + diagonal * layout.height + lane)]);
        };
        for (;;) {
            path_.push_back({part.region.first_row + i, part.region.first_column + j});
            if (i == 0 && ends_in_first_row(part, j)) return end_value;
            const kernels::Predecessor code = j == 0   ? kernels::up
                                              : i == 0 ? first_row_code(part, j, code_at())
                                                       : code_at();
            i -= code != kernels::left;
            j -= code != kernels::up;
            if (i < 0) return end_value;
        }
    }

    bool ends_in_first_row(const Part& part, std::ptrdiff_t j) const noexcept {
        return part.starts_here && (j == 0 || problem_.open_begin);
    }

    // A part below another is entered from above its first column only, so the diagonal leads out
    // of its first row from the second column. (Where all values have overflown to inf, the codes
    // of the first row say nothing.)
    static kernels::Predecessor first_row_code(const Part& part, std::ptrdiff_t j,
                                               kernels::Predecessor code) noexcept {
        const bool may_leave = !part.starts_here && j == 1 && code == kernels::diagonal;
        return may_leave ? kernels::diagonal : kernels::left;
    }

    const SweepProblem& problem_;
    std::ptrdiff_t max_codes_;
    IndexPairs path_;
};

}  // namespace

Path find_path(const SweepProblem& problem, bool open_end, std::ptrdiff_t max_codes) {
    PathFinder finder(problem, max_codes);
    const double value = finder.find({whole_table(problem.curves), true, 0.0, open_end});
    return {value, finder.take()};
}

}  // namespace curvewise::warping
