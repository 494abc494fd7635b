// Converts a dict of Python's options, by name, to the library's. Missing options keep the default
// of the C++ struct. A name that the measure does not have raises a TypeError. A value out of
// range, of whatever type, raises a ValueError that lists the valid values.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#include "curvewise/measure.hpp"
#include "own_distances.hpp"

namespace curvewise::bindings {

namespace py = pybind11;

// Whether an object is a str that reads `text`.
bool is_text(const py::object& given, const char* text);

// "unknown metric 'foo'; choose from euclidean, ..."
[[noreturn]] void refuse_choice(const char* option, const py::object& given,
                                const char* const* names, std::size_t count);

// A whole number within the range, one beyond ptrdiff_t cut to its largest value.
std::ptrdiff_t whole_number(const char* option, const py::object& given,
                            const WholeNumberRange& range);

// Four whole numbers within the range; zeros if given is None.
std::array<std::ptrdiff_t, 4> four_whole_numbers(const char* option, const py::object& given,
                                                 const WholeNumberRange& range);

// A float between 0 and 1; nullopt for any other object.
std::optional<double> proper_fraction(const py::object& given);

// A number within the range. If None is allowed, None gives infinity; otherwise the number must be
// finite.
double real_number(const char* option, const py::object& given, const RealNumberRange& range,
                   bool may_be_none);

// Python's truth.
bool is_true(const py::object& given);

// The order of minkowski; no other metric takes one.
double minkowski_order(const py::object& p, Metric metric);

// The radius of haversine; no other metric takes one.
double sphere_radius(const py::object& radius, Metric metric);

// Whether the options belong to a batch, which also has workers and a cutoff.
enum class OptionsOf { pair, batch };

// The contents of a Python StepPattern: its rows and its divisor.
StepRows step_rows_of(const py::object& pattern);

// (rows, divisor), as Python has them.
py::tuple as_tuple(const StepRows& pattern);

// Reads the options of one measure (see curvewise/options.hpp): from a dict, or from a tuple that
// has the value of every one in the measure's order.
class OptionReader {
   public:
    // `own` receives a custom metric; null if the measure does not take one.
    OptionReader(const py::dict& given, OptionsOf what, OwnDistances* own) noexcept
        : given_(given), what_(what), own_(own) {}
    OptionReader(const py::tuple& values, OwnDistances* own) noexcept
        : given_(values), what_(OptionsOf::pair), own_(own), is_tuple_(true) {}

    template <class Enum>
    std::enable_if_t<std::is_enum_v<Enum>> operator()(const char* name, Enum& value) {
        if (const py::object object = take(name)) value = choose<Enum>(name, object);
    }
    void operator()(const char* name, bool& value) {
        if (const py::object object = take(name)) value = is_true(object);
    }
    // Only `workers` is a plain number.
    void operator()(const char* name, std::ptrdiff_t& value, const WholeNumberRange& range) {
        if (what_ == OptionsOf::batch) return;
        if (const py::object object = take(name)) value = whole_number(name, object, range);
    }
    void operator()(const char* name, std::array<std::ptrdiff_t, 4>& value,
                    const WholeNumberRange& range) {
        if (const py::object object = take(name)) value = four_whole_numbers(name, object, range);
    }
    void operator()(const char* name, std::optional<std::ptrdiff_t>& value,
                    std::optional<double>& fraction, const WholeNumberRange& range) {
        const py::object object = take(name);
        if (!object || object.is_none()) return;
        fraction = proper_fraction(object);
        if (!fraction) value = whole_number(name, object, range);
    }
    void operator()(const char* name, std::ptrdiff_t& value, bool& continuous,
                    const WholeNumberRange& range) {
        const py::object object = take(name);
        if (!object) return;
        continuous = is_text(object, "continuous");
        if (!continuous) value = whole_number(name, object, range);
    }
    void operator()(const char* name, double& value, const RealNumberRange& range) {
        if (what_ == OptionsOf::batch && is_of_batch(name)) return;
        const bool may_be_none = value == std::numeric_limits<double>::infinity();
        if (const py::object object = take(name)) {
            value = real_number(name, object, range, may_be_none);
        }
    }
    // A step pattern by its name, or a custom one.
    void operator()(const char* name, StepPattern& value, StepRows& own) {
        const py::object object = take(name);
        if (object && !PyUnicode_Check(object.ptr()) && py::hasattr(object, "rows")) {
            own = step_rows_of(object);
        } else if (object) {
            value = choose<StepPattern>(name, object);
        }
    }
    void operator()(GroundDistance& ground) {
        const py::object metric = take("metric");
        if (metric && !PyUnicode_Check(metric.ptr()) && is_own_metric(metric)) {
            return read_own(ground, metric);
        }
        if (metric) ground.metric = choose<Metric>("metric", metric);
        const py::object p = take("p");
        if (p && !p.is_none()) ground.p = minkowski_order(p, ground.metric);
        const py::object radius = take("radius");
        if (radius && !radius.is_none()) ground.radius = sphere_radius(radius, ground.metric);
    }

    // Whether a number is not the measure's but the batch's.
    static bool is_of_batch(const char* name) noexcept { return std::strcmp(name, "cutoff") == 0; }

    // How many values have been read.
    py::ssize_t taken() const noexcept { return taken_; }

   private:
    // A custom metric, which excludes p and radius.
    void read_own(GroundDistance& ground, const py::object& metric);
    // An option's value, or a null object where it is not given.
    py::object take(const char* name);
    // In a dict, from behind the option that was found last: most are in the measure's order. To
    // make a str of each name and look that up takes ten times as long.
    PyObject* find(const char* name) noexcept;

    template <class Enum>
    static Enum choose(const char* option, const py::object& given) {
        constexpr auto names = choice_names(Enum{});
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (is_text(given, names[i])) return static_cast<Enum>(i);
        }
        refuse_choice(option, given, names.data(), names.size());
    }

    py::handle given_;
    OptionsOf what_;
    OwnDistances* own_;
    bool is_tuple_ = false;
    py::ssize_t taken_ = 0;
    py::ssize_t place_ = 0;  // behind the option of the dict that was found last
};

// TypeError: "dtw has no option 'foo'; it has metric, p, ..."
[[noreturn]] void refuse_unknown_option(const char* measure, const py::dict& given,
                                        const py::dict& valid);

// The options with their values, by name, as Python has them.
class OptionWriter {
   public:
    explicit OptionWriter(py::dict& options) noexcept : options_(options) {}

    template <class Enum>
    std::enable_if_t<std::is_enum_v<Enum>> operator()(const char* name, Enum value) {
        // Interned, as strings in a user's code are: the same object, so its letters need no
        // comparison.
        const char* const choice = choice_names(value)[static_cast<std::size_t>(value)];
        options_[name] = py::reinterpret_steal<py::object>(PyUnicode_InternFromString(choice));
    }
    void operator()(const char* name, bool value) { options_[name] = value; }
    void operator()(const char* name, std::ptrdiff_t value, const WholeNumberRange& /*range*/) {
        options_[name] = value;
    }
    void operator()(const char* name, const std::array<std::ptrdiff_t, 4>& value,
                    const WholeNumberRange& /*range*/) {
        const bool is_none = value == std::array<std::ptrdiff_t, 4>{};
        options_[name] = is_none
                             ? py::object(py::none())
                             : py::object(py::make_tuple(value[0], value[1], value[2], value[3]));
    }
    void operator()(const char* name, const std::optional<std::ptrdiff_t>& value,
                    const std::optional<double>& fraction, const WholeNumberRange& /*range*/) {
        options_[name] = value      ? py::object(py::int_(*value))
                         : fraction ? py::object(py::float_(*fraction))
                                    : py::object(py::none());
    }
    void operator()(const char* name, std::ptrdiff_t value, bool continuous,
                    const WholeNumberRange& /*range*/) {
        options_[name] = continuous ? py::object(py::str("continuous")) : py::int_(value);
    }
    void operator()(const char* name, double value, const RealNumberRange& /*range*/) {
        const bool is_none = value == std::numeric_limits<double>::infinity();
        options_[name] = is_none ? py::object(py::none()) : py::object(py::float_(value));
    }
    void operator()(const char* name, StepPattern value, const StepRows& /*own*/) {
        (*this)(name, value);
    }
    void operator()(const GroundDistance& ground) {
        (*this)("metric", ground.metric);
        const bool has_order = ground.metric == Metric::minkowski;
        options_["p"] = has_order ? py::object(py::float_(ground.p)) : py::object(py::none());
        const bool has_radius = ground.metric == Metric::haversine;
        options_["radius"] =
            has_radius ? py::object(py::float_(ground.radius)) : py::object(py::none());
    }

   private:
    py::dict& options_;
};

template <class Options>
py::dict written(Options options) {
    py::dict result;
    visit_options(options, OptionWriter(result));
    return result;
}

template <class Options>
Options read_options(const py::dict& given, OptionsOf what = OptionsOf::pair,
                     OwnDistances* own = nullptr) {
    Options options;
    OptionReader reader(given, what, OwnDistances::are_taken_by<Options> ? own : nullptr);
    visit_options(options, reader);
    if (reader.taken() < static_cast<py::ssize_t>(given.size())) {
        py::dict valid = written(options);
        if (what == OptionsOf::batch) {
            for (const char* own : {"workers", "cutoff"}) valid.attr("pop")(own, py::none());
        }
        refuse_unknown_option(Options::measure, given, valid);
    }
    return options;
}

// Throws where there are not as many; whether each is the default, at a glance.
bool are_defaults(const py::tuple& values, const py::tuple& defaults);

// Reads a tuple of the values of all options in the measure's order. Most calls pass the very
// objects of the tuple of defaults; then nothing is read.
template <class Options>
Options read_options(const py::tuple& values, const py::tuple& defaults, OwnDistances& own) {
    Options options;
    if (are_defaults(values, defaults)) return options;
    OptionReader reader(values, OwnDistances::are_taken_by<Options> ? &own : nullptr);
    visit_options(options, reader);
    return options;
}

// A measure by its name, with its options, for a batch.
Measure read_measure(const py::object& name, const py::dict& options);

}  // namespace curvewise::bindings
