#include "planar/function_strips.hpp"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>

namespace curvewise::planar {
namespace {

using curves::CheckedCurve;
using curves::RangeScale;

std::string span(const FunctionWalk& function, const RangeScale& range) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << "from " << range.restore(function.low(), 1) << " to "
         << range.restore(function.high(), 1);
    return text.str();
}

}  // namespace

double strip_area(const Quad& strip) noexcept {
    const double first = strip.a.y - strip.d.y, last = strip.b.y - strip.c.y;
    const double sum = std::abs(first) + std::abs(last);
    const double width = strip.b.x - strip.a.x;
    if (!(first < 0.0 && last > 0.0) && !(first > 0.0 && last < 0.0)) return 0.5 * (width * sum);
    // Two triangles, whose widths are as their heights.
    return 0.5 * (width * (std::abs(first) * (std::abs(first) / sum) +
                           std::abs(last) * (std::abs(last) / sum)));
}

double strip_squares(const Quad& strip) noexcept {
    const double first = strip.a.y - strip.d.y, last = strip.b.y - strip.c.y;
    // (first^2 + first last + last^2) / 3 without its cancellation.
    const double middle = 0.5 * (first + last), half = 0.5 * (last - first);
    return (strip.b.x - strip.a.x) * (middle * middle + half * half / 3.0);
}

FunctionWalk::FunctionWalk(const CheckedCurve& checked, const RangeScale& range,
                           runtime::Poller& poller) {
    check_is_function(checked, poller);
    points_ = curves::polyline(checked.curve, range, poller);
    if (high() < low()) std::reverse(points_.begin(), points_.end());
}

FunctionStrips::FunctionStrips(const CheckedCurve& P, const CheckedCurve& Q,
                               const RangeScale& range, runtime::Poller& poller)
    : p_(P, range, poller),
      q_(Q, range, poller),
      low_(std::max(p_.low(), q_.low())),
      high_(std::min(p_.high(), q_.high())) {
    if (low_ < high_) return;
    throw std::invalid_argument(P.name + " spans x " + span(p_, range) + " and " + Q.name + " " +
                                span(q_, range) +
                                "; area with spacing='function' needs a common span");
}

void check_is_function(const CheckedCurve& checked, runtime::Poller& poller) {
    const auto& curve = checked.curve;
    double direction = 0.0;
    for (std::ptrdiff_t i = 1; i < curve.size(); ++i) {
        poller.poll_in_loop(static_cast<std::size_t>(i));
        const double before = curve(i - 1, 0), here = curve(i, 0);
        const double step = static_cast<double>(here > before) - static_cast<double>(here < before);
        if (step * direction < 0.0) {
            throw std::invalid_argument(
                checked.name + "[" + std::to_string(i) +
                "] reverses in x; area with spacing='function' needs x that only rises or only "
                "falls: sort the points by x, or choose another spacing");
        }
        if (step != 0.0) direction = step;
    }
}

}  // namespace curvewise::planar
