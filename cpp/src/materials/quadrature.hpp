// The integral from 0 to x of a sum of exp(-rate s), times an equally smooth function. The largest
// rate is known. Gauss-Legendre with 16 nodes on panels that double in length: steep terms have
// decayed where the panels are long. Accurate to rounding. Nodes and weights: Abramowitz & Stegun,
// "Handbook of Mathematical Functions", table 25.4.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "materials/dual.hpp"
#include "materials/path.hpp"

namespace curvewise::materials {

template <class Number, class Function>
Number integral_of_decays(const Number& x, double largest_rate, Function function) {
    constexpr std::array<double, 8> nodes{0.095012509837637440185, 0.281603550779258913230,
                                          0.458016777657227386342, 0.617876244402643748447,
                                          0.755404408355003033895, 0.865631202387831743880,
                                          0.944575023073232576078, 0.989400934991649932596};
    constexpr std::array<double, 8> weights{0.189450610455068496285, 0.182603415044923588867,
                                            0.169156519395002538189, 0.149595988816576732081,
                                            0.124628971255533872052, 0.095158511682492784810,
                                            0.062253523938647892863, 0.027152459411754094852};
    Number sum(0.0);
    // Panels as fractions of x, so that their ends move with it.
    const double range = largest_rate * value_of(x);
    if (!(range < 1e18)) {  // some 60 panels; infinity would take panels without end
        throw NoStress{"the modulus decays beside hardening too steep to integrate", "xi"};
    }
    double from = 0.0, to = range > 2.0 ? 2.0 / range : 1.0;
    while (from < 1.0) {
        const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            sum += half * weights[i] *
                   (function(x * (middle - half * nodes[i])) +
                    function(x * (middle + half * nodes[i])));
        }
        from = to;
        to = std::min(1.0, 2.0 * to);
    }
    return sum * x;
}

}  // namespace curvewise::materials
