#include "options.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <tuple>

#include "curvewise/compare.hpp"

namespace curvewise::bindings {
namespace {

std::string repr(const py::object& given) { return py::repr(given).cast<std::string>(); }

// Collects the choices of the options that have choices.
class ChoiceCollector {
   public:
    explicit ChoiceCollector(py::dict& choices) noexcept : choices_(choices) {}

    template <class Enum>
    std::enable_if_t<std::is_enum_v<Enum>> operator()(const char* name, Enum /*value*/) {
        constexpr auto names = choice_names(Enum{});
        py::tuple list(names.size());
        for (std::size_t i = 0; i < names.size(); ++i) list[i] = names[i];
        choices_[name] = list;
    }
    void operator()(const GroundDistance& ground) { (*this)("metric", ground.metric); }
    void operator()(const char* name, StepPattern value, const StepRows& /*own*/) {
        (*this)(name, value);
    }
    template <class... Other>
    void operator()(const char* /*name*/, const Other&... /*not a choice*/) noexcept {}

   private:
    py::dict& choices_;
};

// Throws where an option of one metric is given with another.
void check_metric_of(const char* option, Metric its, Metric metric) {
    if (metric == its) return;
    const auto name = [](Metric of) {
        return "'" + std::string(choice_names(of)[static_cast<std::size_t>(of)]) + "'";
    };
    throw py::value_error(std::string(option) + " applies to metric=" + name(its) +
                          " only, not to " + name(metric));
}

// Throws unless the option is None; for options that a custom metric excludes.
void refuse_beside_own(const char* option, const py::object& given) {
    if (!given || given.is_none()) return;
    throw py::value_error(std::string(option) +
                          " applies to a metric by its name, not to one of one's own");
}

// For measures and batches that do not take a custom metric.
[[noreturn]] void refuse_own_metric() {
    std::string names;
    for (const char* name : choice_names(Metric{}))
        names += (names.empty() ? "" : ", ") + std::string(name);
    throw py::value_error(
        "a metric of one's own is for dtw and frechet of one pair, their paths, tables and infos, "
        "and as a callable for cdist and pdist of them; nothing else computes with it, or has "
        "bounds of it: choose from " +
        names);
}

template <class Options>
py::dict changed_options(const Options& options) {
    const py::dict defaults = written(Options{}), all = written(options);
    py::dict changed;
    for (const auto& [name, value] : all) {
        if (!value.equal(defaults[name])) changed[name] = value;
    }
    return changed;
}

// What to write instead of an option, or nothing.
std::string option_hint(const char* measure, const py::handle& given, const py::list& known) {
    const py::object function = py::module_::import("curvewise._names").attr("option_hint");
    return function(measure, given, known).cast<std::string>();
}

// "; did you mean 'dtw'?", or nothing.
std::string did_you_mean(const py::handle& given, const py::list& known) {
    const py::object function = py::module_::import("curvewise._names").attr("did_you_mean");
    return function(py::make_tuple(given), known).cast<std::string>();
}

}  // namespace

bool is_text(const py::object& given, const char* text) {
    return PyUnicode_Check(given.ptr()) && PyUnicode_CompareWithASCIIString(given.ptr(), text) == 0;
}

void refuse_choice(const char* option, const py::object& given, const char* const* names,
                   std::size_t count) {
    std::string list;
    py::list known;
    for (std::size_t i = 0; i < count; ++i) {
        list += (i == 0 ? "" : ", ") + std::string(names[i]);
        known.append(names[i]);
    }
    throw py::value_error("unknown " + std::string(option) + " " + repr(given) + "; choose from " +
                          list + did_you_mean(given, known));
}

std::ptrdiff_t whole_number(const char* option, const py::object& given,
                            const WholeNumberRange& range) {
    if (PyIndex_Check(given.ptr()) && !PyBool_Check(given.ptr())) {
        // Without an exception type, a number out of range is cut to the range.
        const Py_ssize_t value = PyNumber_AsSsize_t(given.ptr(), nullptr);
        if (!PyErr_Occurred() && value >= range.least) return value;
        PyErr_Clear();
    }
    throw py::value_error(std::string(option) + " is " + repr(given) + "; " + range.advice);
}

std::array<std::ptrdiff_t, 4> four_whole_numbers(const char* option, const py::object& given,
                                                 const WholeNumberRange& range) {
    std::array<std::ptrdiff_t, 4> result = {};
    if (given.is_none()) return result;
    const bool is_list = py::isinstance<py::sequence>(given) && !py::isinstance<py::str>(given) &&
                         !py::isinstance<py::bytes>(given);
    if (!is_list || py::len(given) != result.size()) {
        throw py::value_error(std::string(option) + " is " + repr(given) + "; " + range.advice);
    }
    std::size_t next = 0;
    for (const py::handle number : given) {
        result[next++] = whole_number(option, py::reinterpret_borrow<py::object>(number), range);
    }
    return result;
}

std::optional<double> proper_fraction(const py::object& given) {
    if (!PyFloat_Check(given.ptr())) return std::nullopt;
    const double value = PyFloat_AS_DOUBLE(given.ptr());
    if (!(value > 0.0 && value < 1.0)) return std::nullopt;
    return value;
}

double real_number(const char* option, const py::object& given, const RealNumberRange& range,
                   bool may_be_none) {
    if (may_be_none && given.is_none()) return std::numeric_limits<double>::infinity();
    const double value = PyFloat_AsDouble(given.ptr());
    if (PyErr_Occurred() || !(value >= range.least) || !(may_be_none || std::isfinite(value))) {
        PyErr_Clear();
        throw py::value_error(std::string(option) + " is " + repr(given) + "; " + range.advice);
    }
    return value;
}

bool is_true(const py::object& given) {
    const int truth = PyObject_IsTrue(given.ptr());
    if (truth < 0) throw py::error_already_set();
    return truth == 1;
}

double minkowski_order(const py::object& p, Metric metric) {
    check_metric_of("p", Metric::minkowski, metric);
    const double order = PyFloat_AsDouble(p.ptr());
    if (PyErr_Occurred() || !(order >= 1.0)) {
        PyErr_Clear();
        throw py::value_error("p is " + repr(p) + "; minkowski needs 1 <= p <= inf");
    }
    return order;
}

double sphere_radius(const py::object& radius, Metric metric) {
    check_metric_of("radius", Metric::haversine, metric);
    const double length = PyFloat_AsDouble(radius.ptr());
    if (PyErr_Occurred() || !(length > 0.0 && std::isfinite(length))) {
        PyErr_Clear();
        throw py::value_error("radius is " + repr(radius) + "; give a finite number > 0");
    }
    return length;
}

constexpr const char* normalizations[] = {"NA", "N", "M", "N+M"};  // in the order of Per

StepRows step_rows_of(const py::object& pattern) {
    StepRows result;
    for (const py::handle row : py::list(pattern.attr("rows"))) {
        const auto [step, rows, columns, weight] = row.cast<std::tuple<int, int, int, double>>();
        result.rows.push_back({step, rows, columns, weight});
    }
    const auto per = pattern.attr("normalization").cast<std::string>();
    const auto* const found = std::find(std::begin(normalizations), std::end(normalizations), per);
    if (found == std::end(normalizations)) {
        refuse_choice("normalization", pattern.attr("normalization"), normalizations,
                      std::size(normalizations));
    }
    result.per = static_cast<Per>(found - normalizations);
    return result;
}

py::tuple as_tuple(const StepRows& pattern) {
    py::list rows;
    for (const StepRow& row : pattern.rows) {
        rows.append(py::make_tuple(row.step, row.rows, row.columns, row.weight));
    }
    return py::make_tuple(py::tuple(rows), normalizations[static_cast<std::size_t>(pattern.per)]);
}

void OptionReader::read_own(GroundDistance& ground, const py::object& metric) {
    if (own_ == nullptr) refuse_own_metric();
    refuse_beside_own("p", take("p"));
    refuse_beside_own("radius", take("radius"));
    ground.own = own_->of(metric);
}

py::object OptionReader::take(const char* name) {
    PyObject* value = nullptr;
    if (is_tuple_) {
        if (taken_ == PyTuple_GET_SIZE(given_.ptr())) {
            throw py::type_error(std::string("there is no value for ") + name);
        }
        value = PyTuple_GET_ITEM(given_.ptr(), taken_);
    } else if (taken_ < PyDict_GET_SIZE(given_.ptr())) {
        value = find(name);
    }
    if (value != nullptr) ++taken_;
    return py::reinterpret_borrow<py::object>(value);
}

PyObject* OptionReader::find(const char* name) noexcept {
    const py::ssize_t start = place_;
    PyObject *key = nullptr, *value = nullptr;
    const auto is_next = [&] {
        return PyUnicode_Check(key) && PyUnicode_CompareWithASCIIString(key, name) == 0;
    };
    while (PyDict_Next(given_.ptr(), &place_, &key, &value)) {
        if (is_next()) return value;
    }
    place_ = 0;
    while (place_ < start && PyDict_Next(given_.ptr(), &place_, &key, &value)) {
        if (is_next()) return value;
    }
    place_ = start;
    return nullptr;
}

bool are_defaults(const py::tuple& values, const py::tuple& defaults) {
    if (values.size() != defaults.size()) {
        throw py::type_error("there are " + std::to_string(values.size()) + " values for " +
                             std::to_string(defaults.size()) + " options");
    }
    bool same = true;
    for (py::ssize_t i = 0; i < PyTuple_GET_SIZE(defaults.ptr()); ++i) {
        PyObject* const value = PyTuple_GET_ITEM(values.ptr(), i);
        PyObject* const standard = PyTuple_GET_ITEM(defaults.ptr(), i);
        // Equal numbers can be different objects; for other values there is only one object.
        same &= value == standard || (PyFloat_CheckExact(value) && PyFloat_CheckExact(standard) &&
                                      PyFloat_AS_DOUBLE(value) == PyFloat_AS_DOUBLE(standard));
    }
    return same;
}

void refuse_unknown_option(const char* measure, const py::dict& given, const py::dict& valid) {
    std::string list;
    py::list known;
    for (const auto& [name, value] : valid) {
        list += (list.empty() ? "" : ", ") + name.cast<std::string>();
        known.append(name);
    }
    known.append("workers");  // of the call, where other packages have n_jobs
    for (const auto& [name, value] : given) {
        if (valid.contains(name)) continue;
        throw py::type_error(std::string(measure) + " has no option " +
                             py::repr(name).cast<std::string>() + "; it has " +
                             (list.empty() ? "none" : list) + option_hint(measure, name, known));
    }
    throw py::type_error("the options of " + std::string(measure) +
                         " changed while they were read");
}

Measure read_measure(const py::object& name, const py::dict& options) {
    std::optional<Measure> found;
    std::vector<const char*> names;
    for_each_measure([&](const auto& defaults) {
        using Options = std::decay_t<decltype(defaults)>;
        names.push_back(Options::measure);
        if (is_text(name, Options::measure)) {
            found = read_options<Options>(options, OptionsOf::batch);
        }
    });
    if (!found) refuse_choice("measure", name, names.data(), names.size());
    return *found;
}

namespace {

// The defaults of every measure's options.
py::dict measure_defaults() {
    py::dict result;
    for_each_measure([&](const auto& options) { result[options.measure] = written(options); });
    return result;
}

// The choices of every option that has choices.
py::dict option_choices() {
    py::dict result;
    for_each_measure([&](auto options) { visit_options(options, ChoiceCollector(result)); });
    return result;
}

// For every preset and measure: whether the curves are scaled, and the options that differ from the
// default.
py::dict preset_conditions() {
    py::dict result;
    constexpr auto names = choice_names(Preset{});
    for (std::size_t i = 0; i < names.size(); ++i) {
        py::dict measures;
        for (const Condition& condition : conditions(static_cast<Preset>(i))) {
            std::visit(
                [&](const auto& options) {
                    measures[options.measure] =
                        py::make_tuple(condition.scaled, changed_options(options));
                },
                condition.measure);
        }
        result[names[i]] = measures;
    }
    return result;
}

py::dict named_step_patterns() {
    py::dict patterns;
    for (const StepSet& one : step_patterns)
        patterns[one.name] = bindings::as_tuple(step_rows(one));
    return patterns;
}

py::tuple rows_of_rabiner_juang(int type, const py::object& weight, bool smoothed) {
    constexpr auto names = choice_names(SlopeWeight{});
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!is_text(weight, names[i])) continue;
        return bindings::as_tuple(rabiner_juang(type, static_cast<SlopeWeight>(i), smoothed));
    }
    refuse_choice("weight", weight, names.data(), names.size());
}

}  // namespace

void bind_options(py::module_& module) {
    module.def("measures", measure_defaults);
    module.def("choices", option_choices);
    module.def("presets", preset_conditions);
    module.def("step_patterns", named_step_patterns);
    module.def("rabiner_juang", rows_of_rabiner_juang);
}

}  // namespace curvewise::bindings
