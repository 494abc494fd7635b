// The table of two curves in one dimension with few active cells in a row (see line.hpp), too few
// to fill the diagonals of a strip. It is filled by some rows at a time, each one column behind the
// row above it. Values stay in registers, a row in each lane, and only the last row is written.
// Pruned cells end the rows at both sides, as in EAPrunedDTW (Herrmann & Webb 2021); here the least
// cost of the rest of a path decides. The kernel of each level includes this file inside its
// anonymous namespace.

// A step waits for the one before it, so that more rows take little longer, as long as there are
// registers for them.
constexpr std::ptrdiff_t line_height = width > 2 ? max_line_height : max_line_height / 2;

template <bool is_squared, bool they_add>
class LineSweep {
   public:
    explicit LineSweep(const Line& line) noexcept : line_(line) {}

    double value() noexcept {
        std::ptrdiff_t row = 0;
        for (; row + height < line_.rows; row += height) {
            if (!sweep(row, height)) return infinity;
        }
        return sweep(row, line_.rows - row) ? last_value_ : infinity;
    }

   private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr std::ptrdiff_t height = line_height;
    static constexpr std::ptrdiff_t packs = height / width;
    static_assert(height % width == 0);

    // The cells of one step: of row k, at the step's column less k.
    struct Cells {
        const double* column_points;  // of column j at [-j]
        Pack points[packs];
        Pack values[packs];
        Pack diagonals[packs];

        // Returns the last row's value of the step before.
        template <class Held>
        double step(std::ptrdiff_t column, double above, Held held) noexcept {
            Pack before = simd::pset1<Pack>(above);
            for (std::ptrdiff_t r = 0; r < packs; ++r) {
                const Pack turned = turn(values[r]);
                const Pack up = with_first_of(before, turned);
                before = turned;
                const Pack least = simd::pmin(simd::pmin(values[r], diagonals[r]), up);
                const Pack delta = simd::psub(points[r], load(column_points - column + r * width));
                const Pack cost = is_squared ? simd::pmul(delta, delta) : simd::pabs(delta);
                diagonals[r] = up;
                values[r] = held(simd::padd(least, cost), r * width);
            }
            return simd::pfirst(before);
        }
        // The least of all values that later steps begin with.
        Pack least() const noexcept {
            Pack least = simd::pmin(values[0], diagonals[0]);
            for (std::ptrdiff_t r = 1; r < packs; ++r) {
                least = simd::pmin(least, simd::pmin(values[r], diagonals[r]));
            }
            return least;
        }
        double last_value() const noexcept { return simd::pfirst(turn(values[packs - 1])); }
    };

    double rest(std::ptrdiff_t row, std::ptrdiff_t column) const noexcept {
        const double rows = line_.after_row[row], columns = line_.after_column[column];
        return they_add ? rows + columns : rows < columns ? columns : rows;
    }
    bool is_dead(std::ptrdiff_t row, std::ptrdiff_t column, double value) const noexcept {
        return !((value + rest(row, column)) * line_.slack <= line_.most);
    }
    // Whether all of them are, of this row and column or before.
    bool are_dead(std::ptrdiff_t row, std::ptrdiff_t column, const Pack& values) const noexcept {
        const Pack whole = simd::padd(values, simd::pset1<Pack>(rest(row, column)));
        return at_most(simd::pmul(whole, simd::pset1<Pack>(line_.slack)),
                       simd::pset1<Pack>(line_.most)) == 0;
    }

    // Sweeps the `rows` rows from `row` on. False if all of the last row is pruned.
    bool sweep(std::ptrdiff_t row, std::ptrdiff_t rows) noexcept {
        const std::ptrdiff_t bottom = row + rows - 1;
        const std::ptrdiff_t first_of_top = first_step(row), last_of_top = last_step(row);
        const std::ptrdiff_t begin = first_ < first_of_top ? first_of_top : first_;
        if (begin > last_ + 1) return false;
        double* const above = line_.row;
        Cells cells = cells_of(row, rows, begin > first_ ? above[begin - 1] : corner_);
        corner_ = infinity;
        above[last_ + 1] = infinity;

        std::ptrdiff_t column = begin;
        const auto step = [&](double from_above, auto held) {
            above[column - height] = cells.step(column, from_above, held);
            ++column;
        };
        const auto all = [](const Pack& values, std::ptrdiff_t) { return values; };
        const auto unless_ended = [&](const Pack& values, std::ptrdiff_t k) {
            const Pack now = simd::pset1<Pack>(static_cast<double>(column));
            return simd::pselect(simd::pcmp_le(now, load(line_.last_step + row + k)), values,
                                 simd::pset1<Pack>(infinity));
        };
        const auto if_begun = [&](const Pack& values, std::ptrdiff_t k) {
            const Pack now = simd::pset1<Pack>(static_cast<double>(column));
            return simd::pselect(simd::pcmp_le(load(line_.first_step + row + k), now),
                                 unless_ended(values, k), simd::pset1<Pack>(infinity));
        };
        // Where the band lets a row begin further to the right, cells before that are infinite.
        if (first_step(bottom) - (rows - 1) > begin) {
            while (column < first_step(bottom)) {
                step(column <= last_ ? above[column] : infinity, if_begun);
            }
        }
        const std::ptrdiff_t last_below = smaller(last_ + 1, last_of_top);
        while (column <= last_below) step(above[column], all);
        // No more values come from above, and soon all lanes are beyond the last one.
        const std::ptrdiff_t last_lane = smaller(last_ + height - 1, last_of_top);
        while (column <= last_lane) step(infinity, all);
        const std::ptrdiff_t end = last_step(bottom) + 1;
        while (column < end) {
            const std::ptrdiff_t place = smaller(column, line_.columns - 1);
            if (are_dead(bottom, place, cells.least())) break;
            if (column < last_of_top) {
                step(infinity, all);
                step(infinity, all);
            } else {
                step(infinity, unless_ended);
            }
        }
        if (bottom == line_.rows - 1) return finish(cells, rows - 1, column == end);
        above[column - height] = cells.last_value();
        first_ = begin;
        last_ = column - height;
        while (first_ <= last_ && is_dead(bottom, first_, above[first_])) ++first_;
        while (last_ >= first_ && is_dead(bottom, last_, above[last_])) --last_;
        return first_ <= last_;
    }

    static std::ptrdiff_t smaller(std::ptrdiff_t a, std::ptrdiff_t b) noexcept {
        return a < b ? a : b;
    }
    std::ptrdiff_t first_step(std::ptrdiff_t row) const noexcept {
        return static_cast<std::ptrdiff_t>(line_.first_step[row]);
    }
    std::ptrdiff_t last_step(std::ptrdiff_t row) const noexcept {
        return static_cast<std::ptrdiff_t>(line_.last_step[row]);
    }

    Cells cells_of(std::ptrdiff_t row, std::ptrdiff_t rows, double corner) const noexcept {
        double last_points[height] = {};  // no points follow them
        const double* points = line_.p + row;
        if (rows < height) {
            std::memcpy(last_points, points, sizeof(double) * static_cast<std::size_t>(rows));
            points = last_points;
        }
        Cells cells;
        cells.column_points = line_.q + line_.columns - 1;
        for (std::ptrdiff_t r = 0; r < packs; ++r) {
            cells.points[r] = load(points + r * width);
            cells.values[r] = cells.diagonals[r] = simd::pset1<Pack>(infinity);
        }
        cells.diagonals[0] = with_first_of(simd::pset1<Pack>(corner), cells.diagonals[0]);
        return cells;
    }

    // After the table's last rows.
    bool finish(const Cells& cells, std::ptrdiff_t lane, bool is_at_end) noexcept {
        double values[height];
        for (std::ptrdiff_t r = 0; r < packs; ++r) store(values + r * width, cells.values[r]);
        last_value_ = values[lane];
        return is_at_end;
    }

    const Line& line_;
    // The active columns of the last swept row; before the first row, the corner alone.
    std::ptrdiff_t first_ = 0;
    std::ptrdiff_t last_ = -1;
    double corner_ = 0.0;
    double last_value_ = infinity;
};

template <bool is_squared>
double sweep_line(const Line& line) noexcept {
    return line.they_add ? LineSweep<is_squared, true>(line).value()
                         : LineSweep<is_squared, false>(line).value();
}

LineFunction select_line(Metric metric) noexcept {
    return metric == Metric::sqeuclidean ? sweep_line<true> : sweep_line<false>;
}
