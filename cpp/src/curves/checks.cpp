#include "curves/checks.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <stdexcept>

#include "curves/sphere.hpp"

namespace curvewise::curves {
namespace {

// A curve among those of a call, and its name when a message needs it.
struct Named {
    const CurveList* list;
    std::size_t i;

    const CurveView& curve() const noexcept { return (*list)[i]; }
    std::string with_shape() const { return list->name_of(i) + " has shape " + shape_of(curve()); }
};

[[noreturn]] void refuse(const std::string& what, const std::string& need) {
    throw std::invalid_argument(what + "; " + need);
}

// x and y in rows are a curve of two points, and the commonest reason for a wrong shape.
bool looks_transposed(const CurveView& curve) noexcept {
    return curve.size() <= 3 && curve.dim() > 3;
}

[[noreturn]] void refuse_shapes(const std::string& what, const std::string& need,
                                std::initializer_list<CurveView> curves) {
    const bool transposed = std::any_of(curves.begin(), curves.end(), looks_transposed);
    refuse(what, need + (transposed ? " (a row is a point: transpose?)" : ""));
}

std::string both(const Named& a, const Named& b) {
    return a.with_shape() + " and " + b.with_shape();
}

void check_columns(const Named& named) {
    if (named.curve().dim() < 1) {
        refuse(named.with_shape(), "a curve needs at least 1 coordinate");
    }
}

void check_points(const Named& named, const Requirements& needs) {
    if (named.curve().size() >= needs.min_points) return;
    refuse(named.with_shape(), std::string(needs.measure) + " needs at least " +
                                   std::to_string(needs.min_points) +
                                   (needs.min_points == 1 ? " point" : " points"));
}

// Calls check(named) for every curve of both lists.
template <class Check>
void for_each(const CurveList& first, const CurveList& second, Check check) {
    for (const CurveList* list : {&first, &second}) {
        for (std::size_t i = 0; i < list->size(); ++i) check(Named{list, i});
    }
}

// Throws for the first entry, in row-major order, that is not finite.
void check_finite(const CurveView& curve, const std::string& name) {
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            const double value = curve(i, c);
            if (std::isfinite(value)) continue;
            std::string place = std::to_string(i);
            if (!curve.is_flat()) place.append(", ").append(std::to_string(c));
            const char* what = std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
            refuse(std::string(name).append("[").append(place).append("] is ").append(what),
                   "curves must be finite");
        }
    }
}

// The largest |entry|, and the sum of all entries, which is not finite where one of them is not.
class Magnitude {
   public:
    void add(double value) noexcept {
        sum_ += value;
        largest_ = std::max(largest_, std::abs(value));
    }
    void add(const Magnitude& other) noexcept {
        sum_ += other.sum_;
        largest_ = std::max(largest_, other.largest_);
    }
    bool is_finite() const noexcept { return std::isfinite(sum_); }
    double largest() const noexcept { return largest_; }

   private:
    double sum_ = 0.0;
    double largest_ = 0.0;
};

// The magnitude of contiguous values.
Magnitude magnitude(const double* values, std::ptrdiff_t count) noexcept {
    Magnitude even, odd;  // which do not wait for each other
    for (std::ptrdiff_t i = 1; i < count; i += 2) {
        even.add(values[i - 1]);
        odd.add(values[i]);
    }
    if (count % 2 != 0) even.add(values[count - 1]);
    even.add(odd);
    return even;
}

// The largest |entry|; throws for the first one, in row-major order, that is not finite.
double largest_magnitude(const CurveView& curve, const std::string& name, runtime::Poller& poller) {
    if (curve.has_floats()) refuse(name + " has floats, which only lists may have", "give doubles");
    Magnitude all;
    const double* const row_major = curve.row_major();
    const std::ptrdiff_t dim = curve.dim();
    poller.in_runs(curve.size(), dim, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        if (row_major != nullptr) {
            all.add(magnitude(row_major + first * dim, (end - first) * dim));
        } else {
            for (std::ptrdiff_t i = first; i < end; ++i) {
                for (std::ptrdiff_t c = 0; c < dim; ++c) all.add(curve(i, c));
            }
        }
    });
    // A sum of large numbers may be infinite, too.
    if (!all.is_finite()) check_finite(curve, name);
    return all.largest();
}

}  // namespace

std::string shape_of(const CurveView& curve) {
    const std::string n = std::to_string(curve.size());
    return "(" + n + (curve.is_flat() ? "," : ", " + std::to_string(curve.dim())) + ")";
}

CheckedCurve::CheckedCurve(const CurveView& view, std::string view_name, runtime::Poller& poller)
    : curve(view), name(std::move(view_name)), largest(largest_magnitude(curve, name, poller)) {}

void CheckedCurve::put_on_sphere() {
    check_on_sphere(curve, name);
    on_sphere = true;
}

void check_shapes(const Requirements& needs, const CurveList& first, const CurveList& second) {
    const CurveList& with_first = first.size() > 0 ? first : second;
    if (with_first.size() == 0) return;
    const Named example{&with_first, 0};
    for_each(first, second, [&](const Named& named) {
        check_columns(named);
        if (named.curve().dim() == example.curve().dim()) return;
        refuse_shapes(both(example, named), "both need the same number of coordinates",
                      {example.curve(), named.curve()});
    });
    if (example.curve().dim() != 2 && (needs.planar || needs.on_sphere)) {
        const std::string need =
            std::string(needs.measure) +
            (needs.planar ? " needs 2 coordinates, x and y"
                          : " with metric='haversine' needs 2 coordinates, longitude and latitude");
        const auto refuse_with = [&](const Named& other) {
            refuse_shapes(both(example, other), need, {example.curve(), other.curve()});
        };
        if (first.size() > 0 && second.size() > 0) refuse_with({&second, 0});
        if (with_first.size() > 1) refuse_with({&with_first, 1});
        refuse_shapes(example.with_shape(), need, {example.curve()});
    }
    for_each(first, second, [&](const Named& named) { check_points(named, needs); });
}

void check_shapes(const Requirements& needs, const CurveList& curves) {
    check_shapes(needs, curves, CurveList(std::vector<CurveView>(), ""));
}

void check_equal_shapes(const CurveView& P, const CurveView& Q, const char* measure) {
    const CurveList p(P, "P"), q(Q, "Q");
    for_each(p, q, check_columns);
    if (P.size() != Q.size() || P.dim() != Q.dim()) {
        refuse(both({&p, 0}, {&q, 0}), std::string(measure) + " needs equal shapes");
    }
    check_points({&p, 0}, {measure, 1, false});
}

void check_whole_number(const char* option, std::ptrdiff_t value, const WholeNumberRange& range) {
    if (value >= range.least) return;
    refuse(std::string(option) + " is " + std::to_string(value), range.advice);
}

void check_limit(const char* option, double limit, bool may_be_negative) {
    const double least = may_be_negative ? -std::numeric_limits<double>::infinity() : 0.0;
    if (limit >= least) return;
    refuse(std::string(option) + " is " + std::to_string(limit),
           may_be_negative ? "give a number" : "give a number >= 0");
}

}  // namespace curvewise::curves
