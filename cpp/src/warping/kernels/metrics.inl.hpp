// The ground distances, one row each: what the library asks of a ground distance, and its
// arithmetic, written once for doubles and for SIMD vectors of them. Included by
// ../ground_distance.hpp, and by the kernel of each level inside its anonymous namespace. There
// `A` does the arithmetic of the one number type or the other, and `Root` takes square roots.
//
// Each row says
//
//   degree          by which power of a factor the distance grows when both curves do; one of
//                   degree 0 is computed on the curves as they are, whatever their range, since
//                   what is small beside the largest coordinate counts in it, too
//   is_norm         whether it is a norm of the differences of coordinates (or its square) of which
//                   each operation is monotone in floating point: distances of boxes, which are
//                   computed by the same operations, then bound those of their points to the bit.
//                   Without one there are no bounds, and nothing is pruned by them
//   is_absolute_in_one_dimension    whether |difference| is computed in its place there
//   is_root         whether it is the root of sqeuclidean, which a table of largest distances then
//                   holds in its place, until one root at the end: roots are monotone
//
// and has
//
//   add, finish     of a norm: adds the difference of one coordinate to a sum, in their order, and
//                   makes the distance of the sum; nothing is fused or reordered
//   distance        of what is not a norm: between two points p(c) and q(c), one pair at a time
//   magnitude       for gradients: what is larger where the distance is, and does not overflow
//   slope           the derivative by coordinate c of the point of Q, times a weight, where the
//                   points are `at` some places that differ, at.p(c) and at.q(c), and have this
//                   magnitude
//
// A row that lacks one of them does not compile, nor does a metric that lacks a row
// (-Werror=switch).

template <class A>
struct Sqeuclidean {
    using Number = typename A::Number;
    static constexpr int degree = 2;
    static constexpr bool is_norm = true;
    static constexpr bool is_absolute_in_one_dimension = false;
    static constexpr bool is_root = false;

    static Number add(const Number& sum, const Number& delta) noexcept {
        return A::sum(sum, A::product(delta, delta));
    }
    static Number finish(const Number& sum) noexcept { return sum; }

    // The root, which never overflows.
    template <class Points>
    static double magnitude(const Points& at) noexcept {
        return at.largest() * std::sqrt(at.sum_of([](double x) { return x * x; }));
    }
    template <class Points>
    static double slope(const Points& at, std::ptrdiff_t c, double weight, double) noexcept {
        return 2.0 * (weight * at.delta(c));
    }
};

template <class A, class Root>
struct Euclidean : Sqeuclidean<A> {
    using Number = typename A::Number;
    static constexpr int degree = 1;
    static constexpr bool is_absolute_in_one_dimension = true;
    static constexpr bool is_root = true;

    static Number finish(const Number& sum) noexcept { return Root::of(sum); }

    template <class Points>
    static double slope(const Points& at, std::ptrdiff_t c, double weight,
                        double magnitude) noexcept {
        return weight * at.delta(c) / magnitude;
    }
};

template <class A>
struct Cityblock {
    using Number = typename A::Number;
    static constexpr int degree = 1;
    static constexpr bool is_norm = true;
    static constexpr bool is_absolute_in_one_dimension = true;
    static constexpr bool is_root = false;

    static Number add(const Number& sum, const Number& delta) noexcept {
        return A::sum(sum, A::absolute(delta));
    }
    static Number finish(const Number& sum) noexcept { return sum; }

    template <class Points>
    static double magnitude(const Points& at) noexcept {
        return at.largest() * at.sum_of([](double x) { return x; });
    }
    template <class Points>
    static double slope(const Points& at, std::ptrdiff_t c, double weight, double) noexcept {
        return weight * at.sign(c);
    }
};

template <class A>
struct Chebyshev {
    using Number = typename A::Number;
    static constexpr int degree = 1;
    static constexpr bool is_norm = true;
    static constexpr bool is_absolute_in_one_dimension = true;
    static constexpr bool is_root = false;

    static Number add(const Number& sum, const Number& delta) noexcept {
        return A::larger(sum, A::absolute(delta));
    }
    static Number finish(const Number& sum) noexcept { return sum; }

    template <class Points>
    static double magnitude(const Points& at) noexcept {
        return at.largest();
    }
    // By the first of the largest.
    template <class Points>
    static double slope(const Points& at, std::ptrdiff_t c, double weight, double) noexcept {
        return c == at.place_of_largest() ? weight * at.sign(c) : 0.0;
    }
};

// Of an order other than 1, 2 and infinity, which are computed as what they are. Powers round as
// they like, which is not monotone.
struct Minkowski {
    static constexpr int degree = 1;
    static constexpr bool is_norm = false;
    static constexpr bool is_absolute_in_one_dimension = true;
    static constexpr bool is_root = false;

    // The largest difference is factored out so that no power overflows.
    template <class P, class Q>
    static double distance(P p, Q q, std::ptrdiff_t dim, double order) noexcept {
        const auto delta = [&](std::ptrdiff_t c) { return std::abs(p(c) - q(c)); };
        double largest = 0.0;
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            if (delta(c) > largest) largest = delta(c);
        }
        double sum = 0.0;
        for (std::ptrdiff_t c = 0; c < dim && largest > 0.0; ++c) {
            sum += std::pow(delta(c) / largest, order);
        }
        return largest * std::pow(sum, 1.0 / order);
    }

    template <class Points>
    static double magnitude(const Points& at) noexcept {
        const double powers = at.sum_of([&](double x) { return std::pow(x, at.order()); });
        return at.largest() * std::pow(powers, 1.0 / at.order());
    }
    template <class Points>
    static double slope(const Points& at, std::ptrdiff_t c, double weight,
                        double magnitude) noexcept {
        const double power = std::pow(std::abs(at.delta(c)) / magnitude, at.order() - 1.0);
        return weight * at.sign(c) * power;
    }
};

// Calls use(row) with the row of a metric.
template <class A, class Root, class Use>
auto with_row(Metric metric, Use use) {
    switch (metric) {
        case Metric::euclidean:
            return use(Euclidean<A, Root>{});
        case Metric::sqeuclidean:
            return use(Sqeuclidean<A>{});
        case Metric::cityblock:
            return use(Cityblock<A>{});
        case Metric::chebyshev:
            return use(Chebyshev<A>{});
        case Metric::minkowski:
            break;
    }
    return use(Minkowski{});
}
