// area, pcm, curve_length and the pointwise measures against the textbook (textbook_planar.hpp), to
// a stated tolerance. It is 1e-12 of the value. If the curves nearly coincide, the value is a small
// remainder of larger numbers. Then it is 1e-12 of the largest possible value (box_size and similar
// functions below). On curves of any kind: no nan, no failure, identical bits by every way.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "check_warping.hpp"
#include "curvewise/curvewise.hpp"
#include "hard_curves.hpp"
#include "record.hpp"
#include "textbook_planar.hpp"

namespace stress {

constexpr double tolerance = 1e-12;

class PlanarCheck {
   public:
    PlanarCheck(Choices& choices, Record& record, Kind kind, const Curve& P, const Curve& Q)
        : choices_(choices),
          record_(record),
          is_tame_(is_tame(kind)),
          P_(P),
          Q_(Q),
          with_{"", {{"P", &P}, {"Q", &Q}}} {}

    void run() {
        check_area();
        if (has_length(P_) && has_length(Q_)) {
            check_pcm();
            check_curve_length();
        }
        check_normalize();
        if (P_.size() == Q_.size()) check_pointwise();
    }

   private:
    static bool has_length(const Curve& curve) {
        for (std::ptrdiff_t i = 1; i < curve.size(); ++i) {
            if (curve(i, 0) != curve(0, 0) || curve(i, 1) != curve(0, 1)) return true;
        }
        return false;
    }
    // The largest difference of two coordinates.
    double box_size() const {
        double size = 0.0;
        for (std::ptrdiff_t c = 0; c < 2; ++c) {
            double low = P_(0, c), high = low;
            for (const Curve* curve : {&P_, &Q_}) {
                for (std::ptrdiff_t i = 0; i < curve->size(); ++i) {
                    low = std::min(low, (*curve)(i, c));
                    high = std::max(high, (*curve)(i, c));
                }
            }
            size = std::max(size, high - low);
        }
        return size;
    }

    // Of any curves: a number, the same through C, in a batch, and by the function for all
    // measures.
    template <class Options>
    double check_ways(const char* name, const Options& options) {
        const double value = curvewise::evaluate(options, P_, Q_);
        record_.is_true(std::string(name) + " is a number", value >= 0.0, with_);
        double out[2] = {-1.0, -1.0};
        const curvewise::BatchOptions batch{any_workers(choices_), any_cutoff(choices_, value)};
        curvewise::cdist({P_}, {Q_, Q_}, options, out, batch);
        record_.same(std::string(name) + ", cdist", out[1], cut(value, batch.cutoff), with_);
        const curvewise::Prepared prepared(P_, options);
        record_.same(std::string(name) + ", Prepared", prepared(Q_), value, with_);
        return value;
    }

    void check_area() {
        curvewise::AreaOptions options;
        options.spacing = static_cast<curvewise::Spacing>(choices_.index(4));
        options.crossing = static_cast<curvewise::Crossing>(choices_.index(2));
        options.squared = choices_.one_in(3);
        const double value = check_ways("area", options);
        curvewise_area_options given = CURVEWISE_AREA_DEFAULTS;
        given.spacing = static_cast<int>(options.spacing);
        given.crossing = static_cast<int>(options.crossing);
        given.squared = options.squared ? 1 : 0;
        const curvewise_curve p = as_c(P_), q = as_c(Q_);
        double found = -1.0;
        curvewise_area(&p, &q, &given, &found, nullptr);
        record_.same("area through C", found, value, with_);
        if (options.spacing == curvewise::Spacing::matched) {
            record_.skip("area, matched: held to curvewise.reference instead");
        } else if (is_tame_) {
            const double size = box_size();
            const double largest = options.squared ? std::pow(size, 4.0) : size * size;
            const double expected = textbook::area(P_, Q_, options);
            record_.close("area", value, expected, tolerance * std::max(expected, largest), with_);
        }
        check_area_quads(options, value);
        std::vector<double> gradient(Q_.values().size());
        if (options.spacing != curvewise::Spacing::arc_length) {
            record_.same("area with its gradient",
                         curvewise::value_and_gradient(options, P_, Q_, gradient.data()), value,
                         with_);
        }
    }

    void check_area_quads(const curvewise::AreaOptions& options, double value) {
        const curvewise::AreaQuads quads = curvewise::area_quads(P_, Q_, options);
        if (!is_tame_ || options.spacing == curvewise::Spacing::matched) return;
        double sum = 0.0;
        for (const double part : quads.areas) sum += options.squared ? part * part : part;
        record_.close("area_quads, added up", sum, value, tolerance * value, with_);
    }

    void check_pcm() {
        curvewise::PcmOptions options;
        options.offsets = choices_.between(1, 12);
        const double value = check_ways("pcm", options);
        const curvewise::PcmMatch match = curvewise::pcm_match(P_, Q_, options);
        record_.same("pcm_match", match.value, value, with_);
        curvewise_pcm_options given = CURVEWISE_PCM_DEFAULTS;
        given.offsets = options.offsets;
        const curvewise_curve p = as_c(P_), q = as_c(Q_);
        double found = -1.0;
        curvewise_pcm(&p, &q, &given, &found, nullptr);
        record_.same("pcm through C", found, value, with_);
        if (!is_tame_) return;
        const textbook::PcmAnswer expected = textbook::pcm(P_, Q_, options.offsets, 0);
        const textbook::Long difference = std::abs(expected.S - expected.T);
        if (difference < 1e-10L * expected.T && difference > 0) {
            record_.skip("pcm: which curve is shorter hangs on rounding");
            return;
        }
        const double scale = static_cast<double>(expected.S * expected.T);
        record_.close("pcm", value, static_cast<double>(expected.value),
                      tolerance * std::max(scale, value), with_);
        if (choices_.one_in(8)) check_pcm_continuous(scale);
    }

    // Not above the value of any grid, and consistent with its offset.
    void check_pcm_continuous(double scale) {
        curvewise::PcmOptions options;
        options.continuous = true;
        const curvewise::PcmMatch match = curvewise::pcm_match(P_, Q_, options);
        const textbook::PcmAnswer expected = textbook::pcm(P_, Q_, 1500, match.offset);
        const auto S = static_cast<double>(expected.S), T = static_cast<double>(expected.T);
        const double rounding = tolerance * std::max(scale, match.value);
        record_.close("pcm, all offsets, at its offset", match.value,
                      static_cast<double>(expected.area_at_best), rounding, with_);
        const auto grid = static_cast<double>(expected.value);
        record_.is_true("pcm, all offsets, not above a grid",
                        match.value <= grid + rounding + 1e-12 * S, with_);
        // The area changes by no more than S times the offset.
        record_.is_true("pcm, all offsets, near the grid",
                        match.value >= grid - S * std::max(T - S, 0.0) / 1499 / 2 - rounding,
                        with_);
    }

    void check_curve_length() {
        curvewise::CurveLengthOptions options;
        options.scale = static_cast<curvewise::LengthScale>(choices_.index(3));
        const textbook::LengthAnswer expected = is_tame_
                                                    ? textbook::curve_length(P_, Q_, options.scale)
                                                    : textbook::LengthAnswer{std::nullopt, 0};
        double value = 0.0;
        try {
            value = check_ways("curve_length", options);
        } catch (const std::invalid_argument& error) {
            const bool is_expected = !is_tame_ || !expected.value;
            record_.is_true("curve_length refused", is_expected, with_, error.what());
            return;
        }
        if (!is_tame_) return;
        if (!expected.value || expected.condition > 1e4L) {
            record_.skip("curve_length: the divisor is 0 nearly to rounding");
            return;
        }
        const double scale = static_cast<double>(expected.condition);
        record_.close("curve_length", value, *expected.value,
                      tolerance * std::max(scale, *expected.value), with_);
        std::vector<double> r(2 * static_cast<std::size_t>(P_.size()));
        curvewise::curve_length_residuals(P_, Q_, r.data(), options);
        double sum = 0.0;
        for (const double x : r) sum += x * x;
        record_.close("curve_length_residuals", std::sqrt(sum), value, tolerance * value, with_);
        std::vector<double> gradient(Q_.values().size());
        record_.same("curve_length with its gradient",
                     curvewise::value_and_gradient(options, P_, Q_, gradient.data()), value, with_);
    }

    void check_normalize() {
        std::vector<double> out(Q_.values().size());
        curvewise::normalize(P_, Q_, out.data());
        if (!is_tame_) return;
        const textbook::Box box(textbook::points_of(P_));
        for (std::ptrdiff_t i = 0; i < Q_.size(); ++i) {
            const auto at = static_cast<std::size_t>(2 * i);
            record_.same("normalize", out[at], (Q_(i, 0) - box.x) / box.width, with_);
            record_.same("normalize", out[at + 1], (Q_(i, 1) - box.y) / box.height, with_);
        }
    }

    void check_pointwise() {
        const double squares = curvewise::sum_of_squares(P_, Q_);
        const double mse = curvewise::mse(P_, Q_), mae = curvewise::mae(P_, Q_);
        record_.is_true("pointwise are numbers", squares >= 0.0 && mse >= 0.0 && mae >= 0.0, with_);
        std::vector<double> gradient(Q_.values().size());
        record_.same("sum_of_squares with its gradient",
                     curvewise::sum_of_squares_and_gradient(P_, Q_, gradient.data()), squares,
                     with_);
        if (!is_tame_) return;
        textbook::Long sum = 0, absolute = 0;
        for (std::size_t k = 0; k < P_.values().size(); ++k) {
            const textbook::Long d = P_.values()[k] - Q_.values()[k];
            sum += d * d;
            absolute += std::abs(d);
            record_.same("gradient of sum_of_squares", gradient[k],
                         2.0 * (Q_.values()[k] - P_.values()[k]) + 0.0, with_);
        }
        const auto count = static_cast<textbook::Long>(P_.values().size());
        const auto check = [&](const char* what, double value, textbook::Long expected) {
            record_.close(what, value, static_cast<double>(expected),
                          tolerance * static_cast<double>(expected), with_);
        };
        check("sum_of_squares", squares, sum);
        check("mse", mse, sum / count);
        check("mae", mae, absolute / count);
    }

    Choices& choices_;
    Record& record_;
    bool is_tame_;
    const Curve& P_;
    const Curve& Q_;
    About with_;
};

inline std::ptrdiff_t check_planar(Choices& choices, Record& record) {
    const Kind kind = any_kind(choices);
    HardCurves curves(choices, kind, 2);
    const Curve P = curves.curve(any_size(choices, 2, 40));
    const Curve Q = curves.other(P, choices.one_in(3) ? P.size() : any_size(choices, 2, 40));
    PlanarCheck(choices, record, kind, P, Q).run();
    return 1;
}

}  // namespace stress
