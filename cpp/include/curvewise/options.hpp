/// \file
/// Options by name, for code that treats all measures in the same way: a language binding, a
/// command line, a configuration file. Every enumeration has the names of its enumerators. Every
/// struct of options has a function visit_options() that calls a visitor with each of them:
///
///     visit(name, value)                     an enumeration or a bool
///     visit(ground)                          a GroundDistance: the options "metric", "p" and
///                                            "radius"
///     visit(name, number, range)             a whole number
///     visit(name, optional_number, optional_fraction, range)
///                                            a whole number, a fraction between 0 and 1, or not
///                                            given
///     visit(name, number, switch, range)     a whole number, or "continuous", which sets the
///                                            switch
///     visit(name, real_number, range)        a number; infinity means no limit
///     visit(name, four_numbers, range)       four whole numbers; four zeros mean not given
///
/// An example is python/bindings/options.hpp, which reads all of them from a dict.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace curvewise {

/// The valid range of a whole number; messages give `advice`.
struct WholeNumberRange {
    std::ptrdiff_t least;
    const char* advice;
};

/// The valid range of a real number; messages give `advice`.
struct RealNumberRange {
    double least;
    const char* advice;
};

/// Of threads.
inline constexpr WholeNumberRange workers_range{
    -1, "give a whole number >= 1, or -1 for all cores"};  // 0 is refused, too
/// Range of the half-width of a band.
inline constexpr WholeNumberRange window_range{
    0, "give a whole number >= 0, a fraction between 0 and 1, or None"};
/// Range of the numbers of points to omit at each end.
inline constexpr WholeNumberRange relax_range{0, "give four whole numbers >= 0, or None"};
/// Range of the number of offsets of pcm.
inline constexpr WholeNumberRange offsets_range{1, "give a whole number >= 1, or 'continuous'"};
/// Range of a cutoff.
inline constexpr RealNumberRange cutoff_range{0.0, "give a number >= 0, or None"};
/// Range of a cutoff for distances that may be negative.
inline constexpr RealNumberRange any_cutoff_range{-std::numeric_limits<double>::infinity(),
                                                  "give a number, or None"};
/// Range of the smoothness of soft_dtw.
inline constexpr RealNumberRange gamma_range{0.0, "give a finite number > 0"};  // 0 is refused, too

/// Range of the cost added to each step of a warping path that leaves the diagonal.
inline constexpr RealNumberRange penalty_range{0.0, "give a number >= 0"};

/// The names of an enumeration's enumerators, in their order, as choice_names() gives them; `last`
/// is the last one there is.
template <auto last, class... Name>
constexpr std::array<const char*, sizeof...(Name)> names_up_to(Name... names) noexcept {
    static_assert(static_cast<std::size_t>(last) + 1 == sizeof...(Name), "one name each");
    return {names...};
}

}  // namespace curvewise
