// The distances of points to the nearest of some boxes (see boxes.hpp), a SIMD vector of points at
// a time: O(points boxes d). The nearest coordinate of a box is subtracted, and the rest is
// computed by the operations of the ground distance. Each of them is monotone in floating point,
// too, so the bound is exact: no point within a box is nearer. The kernel of each level includes
// this file inside its anonymous namespace.

// Each point's own box.
template <class Norm, int fixed_dim, bool keeps_nearest>
void least_of_own(const PointsAndBoxes& sides) noexcept {
    const double* const points = sides.points;
    const double* const low = sides.low;
    const double* const high = sides.high;
    double* const least = sides.least;
    double* const nearest = sides.nearest;
    const std::ptrdiff_t dim = fixed_dim > 0 ? fixed_dim : sides.dim;
    for (std::ptrdiff_t k = 0, count = sides.count; k < count; k += width) {
        Pack sum = simd::pset1<Pack>(0.0);
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            const Pack x = load(points + c * sides.stride + k);
            const std::ptrdiff_t corner = c * sides.corner_stride + k;
            const Pack inside = simd::pmax(simd::pmin(x, load(high + corner)), load(low + corner));
            sum = Norm::add(sum, simd::psub(x, inside));
            if (keeps_nearest) store(nearest + k, inside);
        }
        store(least + k, Norm::finish(sum));
    }
}

double sum(const double* terms, std::ptrdiff_t count) noexcept {
    Pack even = simd::pset1<Pack>(0.0), odd = even;
    std::ptrdiff_t k = 0;
    for (; k + 2 * width <= count; k += 2 * width) {
        even = simd::padd(even, load(terms + k));
        odd = simd::padd(odd, load(terms + k + width));
    }
    double lanes[width];
    store(lanes, simd::padd(even, odd));
    double sum = 0.0;
    for (const double lane : lanes) sum += lane;
    for (; k < count; ++k) sum += terms[k];
    return sum;
}

template <class Norm, int fixed_dim>
void least(const PointsAndBoxes& sides) noexcept {
    if (sides.low != nullptr) {
        return fixed_dim == 1 && sides.nearest != nullptr
                   ? least_of_own<Norm, fixed_dim, fixed_dim == 1>(sides)
                   : least_of_own<Norm, fixed_dim, false>(sides);
    }
    const std::ptrdiff_t dim = fixed_dim > 0 ? fixed_dim : sides.dim;
    for (std::ptrdiff_t k = 0; k < sides.count; k += width) {
        std::ptrdiff_t begin = 0, end = sides.box_count;
        if (sides.first_box != nullptr) {
            const std::ptrdiff_t last = k + width < sides.count ? k + width - 1 : sides.count - 1;
            const std::ptrdiff_t* const first_box = sides.first_box;
            const std::ptrdiff_t* const last_box = sides.last_box;
            begin = first_box[k] < first_box[last] ? first_box[k] : first_box[last];
            end = (last_box[k] > last_box[last] ? last_box[k] : last_box[last]) + 1;
        }
        Pack best = simd::pset1<Pack>(std::numeric_limits<double>::infinity());
        for (std::ptrdiff_t b = begin; b < end; ++b) {
            const double* const low = sides.boxes + b * 2 * dim;
            const double* const high = low + dim;
            Pack sum = simd::pset1<Pack>(0.0);
            for (std::ptrdiff_t c = 0; c < dim; ++c) {
                const Pack x = load(sides.points + c * sides.stride + k);
                const Pack inside = simd::pmax(simd::pmin(x, simd::pset1<Pack>(high[c])),
                                               simd::pset1<Pack>(low[c]));
                sum = Norm::add(sum, simd::psub(x, inside));
            }
            best = simd::pmin(best, sum);
        }
        store(sides.least + k, Norm::finish(best));
    }
}

template <class Norm>
LeastFunction select_least_in(std::ptrdiff_t dim) noexcept {
    if (dim == 1) return least<Norm, 1>;
    if (dim == 2) return least<Norm, 2>;
    if (dim == 3) return least<Norm, 3>;
    return least<Norm, 0>;
}

LeastFunction select_least(Metric metric, std::ptrdiff_t dim) noexcept {
    return with_row<PackArithmetic, DividerRoot>(metric, [=](auto row) -> LeastFunction {
        using Row = decltype(row);
        if constexpr (Row::is_norm) {
            return select_least_in<Row>(dim);
        } else {
            return nullptr;
        }
    });
}

// Computes, in place, the extremes of windows of `to` values from those of windows of `from`
// values, with at most four of the latter for each. A window begins where its result is written,
// and nothing before that place is read again.
void lengthen(const double* low, const double* high, const SlidingWindow& window,
              std::ptrdiff_t from, std::ptrdiff_t to) noexcept {
    const std::ptrdiff_t last = to - from;
    const std::ptrdiff_t second = from < last ? from : last;
    const std::ptrdiff_t third = 2 * from < last ? 2 * from : last;
    double* const least = window.low;
    double* const greatest = window.high;
    for (std::ptrdiff_t k = 0, count = window.count + window.length - to; k < count; k += width) {
        const double* const a = low + k;
        const double* const b = high + k;
        store(least + k, simd::pmin(simd::pmin(load(a), load(a + second)),
                                    simd::pmin(load(a + third), load(a + last))));
        store(greatest + k, simd::pmax(simd::pmax(load(b), load(b + second)),
                                       simd::pmax(load(b + third), load(b + last))));
    }
}

void extremes(const SlidingWindow& window) noexcept {
    std::ptrdiff_t length = window.length < 4 ? window.length : 4;
    lengthen(window.values, window.values, window, 1, length);
    while (length < window.length) {
        const std::ptrdiff_t longer = window.length < 4 * length ? window.length : 4 * length;
        lengthen(window.low, window.high, window, length, longer);
        length = longer;
    }
}

// What makes bounds of distances under an arc.
void arcs(double* values, std::ptrdiff_t count, double radius) noexcept {
    for (std::ptrdiff_t k = 0; k < count; k += width) {
        const std::ptrdiff_t here = count - k < width ? count - k : width;
        double lanes[width] = {};
        for (std::ptrdiff_t i = 0; i < here; ++i) lanes[i] = values[k + i];
        store(lanes, Arc::finish(load(lanes), simd::pset1<Pack>(radius)));
        for (std::ptrdiff_t i = 0; i < here; ++i) values[k + i] = lanes[i];
    }
}
