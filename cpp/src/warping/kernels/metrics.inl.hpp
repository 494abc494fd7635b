// The ground distances, one row each: the properties that the library needs and the arithmetic,
// written once for doubles and for SIMD vectors. ../ground_distance.hpp includes this file, and so
// does the kernel of each level, inside its anonymous namespace. There `A` does the arithmetic of
// one number type, and `Root` takes square roots.
//
// Each row has the properties
//
//   degree          if both curves are multiplied by a factor, the distance is multiplied by this
//                   power of the factor. Degree 0 is computed on unscaled curves, whatever their
//                   range, because small differences between large coordinates matter, too
//   is_norm         whether it is a norm of the differences of coordinates (or its square), and
//                   each operation is monotone in floating point. Distances of boxes, computed by
//                   the same operations, are then exact bounds of the distances of their points.
//                   A distance that is not a norm has no bounds, and nothing is pruned by them
//   is_absolute_in_one_dimension    whether |difference| replaces it there
//   is_root         whether it is the root of sqeuclidean, or another function of it that is
//                   monotone in floating point. A table of largest distances then holds sqeuclidean
//                   instead, and takes one root at the end. If such a function is not a norm,
//                   sqeuclidean has the bounds, and the function is applied to each bound
//   takes_degrees   whether points are longitudes and latitudes in degrees, which are checked, and
//                   packed as points of the unit sphere
//
// and the functions
//
//   add, finish     for a norm: add() adds the difference of one coordinate to a sum, in the order
//                   of coordinates; finish() makes the distance of the sum. Nothing is fused or
//                   reordered
//   finish          for another root: the same, given the radius
//   distance        for the rest: between two points p(c) and q(c), one pair at a time
//   magnitude       for gradients: a number that grows with the distance and does not overflow
//   slope           the derivative by coordinate c of the point of Q, times a weight. The points
//                   are `at` different places, at.p(c) and at.q(c), and have this magnitude
//
// A row that lacks a member does not compile, nor does a metric without a row (-Werror=switch).

template <class A>
struct Sqeuclidean {
    using Number = typename A::Number;
    static constexpr int degree = 2;
    static constexpr bool is_norm = true;
    static constexpr bool is_absolute_in_one_dimension = false;
    static constexpr bool is_root = false;
    static constexpr bool takes_degrees = false;

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
    static constexpr bool takes_degrees = false;

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
    static constexpr bool takes_degrees = false;

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

// For orders other than 1, 2 and infinity, which have their own rows. The rounding of powers is not
// monotone.
struct Minkowski {
    static constexpr int degree = 1;
    static constexpr bool is_norm = false;
    static constexpr bool is_absolute_in_one_dimension = true;
    static constexpr bool is_root = false;
    static constexpr bool takes_degrees = false;

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

// The great-circle distance between points of the sphere. curves/sphere.hpp puts them on the sphere
// of diameter 1, so that sqeuclidean is h, the square of half the chord of the unit sphere. The arc
// is 2 asin(sqrt(h)). Beyond a right angle it is pi - 2 asin(sqrt(1 - h)), whose 1 - h is exact.
// With s = sqrt(h), asin(s) = s + s (z P(z)), z = s s <= 1/2. P has 19 coefficients by
// interpolation in the Chebyshev nodes, with an error of 1e-17 of asin(s).
//
// The rounding is monotone. Between neighbours s grows by at least 2^-53 s, and asin(s) by more. s
// (z P(z)) is at most 0.111 s, and its rounding comes to half of that growth for both together. So
// rounding never reverses the order of two arcs.
template <class A, class Root>
struct Haversine {
    using Number = typename A::Number;
    static constexpr int degree = 0;
    static constexpr bool is_norm = false;
    static constexpr bool is_absolute_in_one_dimension = false;
    static constexpr bool is_root = true;
    static constexpr bool takes_degrees = true;

    static Number finish(const Number& sum, const Number& radius) noexcept {
        const Number half = A::number(0.5), quarter_turn = A::number(1.5707963267948966);
        const Number h = A::smaller(sum, A::number(1.0));
        const Number s = Root::of(A::smaller(h, A::difference(A::number(1.0), h)));
        const Number z = A::product(s, s);
        const Number arc = A::sum(s, A::product(s, A::product(z, series(z))));
        const Number angle = A::where_at_most(h, half, arc, A::difference(quarter_turn, arc));
        return A::product(angle, A::sum(radius, radius));
    }

    // Only haversine asks its points for where on the sphere they are.
    template <class Points>
    static double magnitude(const Points& at) noexcept {
        return at.half_chord();
    }
    template <class Points>
    static double slope(const Points& at, std::ptrdiff_t c, double weight, double) noexcept {
        return weight * at.slope_on_sphere(c);
    }

   private:
    // The even powers and the odd ones, which do not wait for each other.
    static Number series(const Number& z) noexcept {
        constexpr double even[] = {0.16666666666666669,  0.04464285714665563,  0.0223721770065477,
                                   0.013975730180211136, 0.011310924828955462, 0.07377343868679113,
                                   0.952265420570822,    4.3847119392409954,   5.436384462318588,
                                   0.8387674099544927};
        constexpr double odd[] = {0.07499999999998412, 0.030381944084994415,   0.017352221539201188,
                                  0.01139924601483468, -0.0032941927380090922, -0.2809947932275328,
                                  -2.3535297860232123, -5.883233416999023,     -3.0948547605199717};
        const Number square = A::product(z, z);
        Number even_sum = A::number(even[9]), odd_sum = A::number(odd[8]);
        for (int k = 8; k >= 0; --k) {
            even_sum = A::sum(A::product(even_sum, square), A::number(even[k]));
            if (k > 0) odd_sum = A::sum(A::product(odd_sum, square), A::number(odd[k - 1]));
        }
        return A::sum(even_sum, A::product(z, odd_sum));
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
        case Metric::haversine:
            return use(Haversine<A, Root>{});
        case Metric::minkowski:
            break;
    }
    return use(Minkowski{});
}
