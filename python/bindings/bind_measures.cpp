// The measures of one pair: values, paths, tables, quadrilaterals, matches and residuals. The
// function for values takes two curves in any form and a tuple of all options, because reading them
// takes most of the time for short curves. The other functions take two arrays, and a dict or a
// tuple of options.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bind_topics.hpp"
#include "curvewise/closed_curves.hpp"
#include "curvewise/common_part.hpp"
#include "curvewise/gradient.hpp"
#include "curvewise/lower_bounds.hpp"
#include "curvewise/soft_dtw.hpp"
#include "interruptible.hpp"
#include "numpy_view.hpp"
#include "options.hpp"

namespace curvewise::bindings {
namespace {

// Whether points are longitudes and latitudes, which leaves no doubt of the layout.
template <class Options>
auto is_on_sphere(const Options& options, int) -> decltype(options.ground, true) {
    return options.ground.metric == Metric::haversine;
}
template <class Options>
bool is_on_sphere(const Options& /*options*/, long) {
    return false;
}

// Calls compute(P, Q, options, control).
template <class Options, class Compute>
auto computed(const CurveArray& P, const CurveArray& Q, const Options& options, Compute compute) {
    const CurveView p = view(P), q = view(Q);
    if (is_layout_in_doubt(p, q) && !is_on_sphere(options, 0)) ask_about_layout(P);
    const double work = options.work(static_cast<double>(p.size()), static_cast<double>(q.size()),
                                     static_cast<double>(p.dim()));
    // The curves are read before the work that the measure knows of.
    const double entries = static_cast<double>(P.size()) + static_cast<double>(Q.size());
    return interruptible(entries + work, py::none(),
                         [&](Control* control) { return compute(p, q, options, control); });
}

// An array that takes over the memory of a vector: copying millions of rows would take long, and
// twice the memory.
template <class Item, class T>
py::array_t<Item> owning_array(std::vector<T>&& rows, std::vector<py::ssize_t> shape) {
    auto owner = std::make_unique<std::vector<T>>(std::move(rows));
    const auto* const data = reinterpret_cast<const Item*>(owner->data());
    const py::capsule capsule(owner.get(),
                              [](void* held) { delete static_cast<std::vector<T>*>(held); });
    owner.release();
    return py::array_t<Item>(std::move(shape), data, capsule);
}

py::tuple as_tuple(Alignment&& alignment) {
    const auto length = static_cast<py::ssize_t>(alignment.path.size());
    return py::make_tuple(alignment.distance, owning_array<std::int64_t>(std::move(alignment.path),
                                                                         {length, py::ssize_t{2}}));
}

py::tuple as_tuple(AreaQuads&& found) {
    const auto count = static_cast<py::ssize_t>(found.areas.size());
    return py::make_tuple(
        owning_array<double>(std::move(found.quads), {count, py::ssize_t{4}, py::ssize_t{2}}),
        owning_array<double>(std::move(found.areas), {count}));
}

py::tuple as_tuple(PcmMatch&& match) {
    const auto count = static_cast<py::ssize_t>(match.points.size());
    return py::make_tuple(match.value, match.offset, match.coverage, match.maps_p ? "P" : "Q",
                          owning_array<double>(std::move(match.points), {count, py::ssize_t{2}}),
                          match.tolerance);
}

py::tuple as_tuple(WarpingInfo&& info) {
    py::dict seconds;
    for (const WarpingInfo::Phase& phase : info.phases) seconds[phase.name] = phase.seconds;
    return py::make_tuple(info.value, info.pruned, info.cells_swept, info.share,
                          py::make_tuple(info.lower, info.upper), seconds);
}

py::tuple as_tuple(Matching&& matching) {
    const auto count = static_cast<py::ssize_t>(matching.parameters.size());
    return py::make_tuple(matching.distance, owning_array<double>(std::move(matching.parameters),
                                                                  {count, py::ssize_t{2}}));
}

// Distance, from P to Q, from Q to P; each of the two as distance, place on P, place on Q.
py::tuple as_tuple(HausdorffPoints&& found) {
    const FarthestPoint &p = found.from_p, &q = found.from_q;
    return py::make_tuple(found.distance, py::make_tuple(p.distance, p.parameter, p.nearest),
                          py::make_tuple(q.distance, q.nearest, q.parameter));
}

py::tuple as_tuple(Interval&& interval) { return py::make_tuple(interval.low, interval.high); }

// Only plain functions of few types are bound. The compiler must compile pybind11's code for each
// type, and it does so once for all functions of that type.

// Options by name, or the values of all in the measure's order.
template <class Options>
Options read_either(const py::object& given, OwnDistances& own) {
    if (!PyTuple_Check(given.ptr())) {
        return read_options<Options>(given.cast<py::dict>(), OptionsOf::pair, &own);
    }
    const py::tuple values(given);
    Options options;
    OptionReader reader(values, OwnDistances::are_taken_by<Options> ? &own : nullptr);
    visit_options(options, reader);
    if (reader.taken() < PyTuple_GET_SIZE(values.ptr())) {
        throw py::type_error(std::string(Options::measure) + " has fewer options than values");
    }
    return options;
}

// What compute(P, Q, options, control) finds, as a tuple.
template <class Options, auto compute>
py::tuple found(const CurveArray& P, const CurveArray& Q, const py::object& options) {
    OwnDistances own(P, Q);
    return as_tuple(computed(P, Q, read_either<Options>(options, own), compute));
}

// The number that compute(P, Q, options, control) finds.
template <class Options, auto compute>
double found_number(const CurveArray& P, const CurveArray& Q, const py::dict& options) {
    OwnDistances own(P, Q);
    return computed(P, Q, read_options<Options>(options, OptionsOf::pair, &own), compute);
}

py::array_t<double> allocate_table(const CurveArray& P, const CurveArray& Q) {
    try {
        return py::array_t<double>({P.shape(0), Q.shape(0)});
    } catch (const py::error_already_set&) {  // numpy names the size in units of its choice
        const double cells = static_cast<double>(P.shape(0)) * static_cast<double>(Q.shape(0));
        const double size = cells * sizeof(double) / (1024.0 * 1024.0 * 1024.0);
        PyErr_Format(PyExc_MemoryError, "no memory for a table of shape (%zd, %zd), %s GiB",
                     P.shape(0), Q.shape(0),
                     py::str("{:.3g}").format(size).cast<std::string>().c_str());
        throw py::error_already_set();
    }
}

// A row of two residuals for each point of P.
py::array_t<double> allocate_residuals(const CurveArray& P, const CurveArray& /*Q*/) {
    return py::array_t<double>({P.shape(0), py::ssize_t{2}});
}

// An array as allocate(P, Q) returns it, filled by fill(P, Q, data, options, control).
template <class Options, auto allocate, auto fill>
py::array_t<double> filled(const CurveArray& P, const CurveArray& Q, const py::object& given) {
    OwnDistances own(P, Q);
    const auto options = read_either<Options>(given, own);
    py::array_t<double> out = allocate(P, Q);
    double* const data = out.mutable_data();
    computed(P, Q, options,
             [&](const CurveView& p, const CurveView& q, const Options& o, Control* control) {
                 fill(p, q, data, o, control);
             });
    return out;
}

// The value, and its derivative by Q in Q's shape.
template <class Compute>
py::tuple value_with_gradient(const CurveArray& Q, Compute compute) {
    py::array_t<double> gradient(std::vector<py::ssize_t>(Q.shape(), Q.shape() + Q.ndim()));
    double* const data = gradient.mutable_data();
    const double value = compute(data);
    return py::make_tuple(value, gradient);
}

// The measure of that name that has derivatives, or nullopt for another name.
std::optional<DifferentiableMeasure> read_differentiable(const std::string& name,
                                                         const py::dict& options) {
    std::optional<DifferentiableMeasure> found;
    detail::for_each_alternative(static_cast<const DifferentiableMeasure*>(nullptr),
                                 [&](const auto& defaults) {
                                     using Options = std::decay_t<decltype(defaults)>;
                                     if (name == Options::measure)
                                         found = read_options<Options>(options);
                                 });
    return found;
}

// The gradient of a measure by its name.
py::tuple gradient_by_name(const std::string& name, const CurveArray& P, const CurveArray& Q,
                           const py::dict& options) {
    const std::optional<DifferentiableMeasure> measure = read_differentiable(name, options);
    return value_with_gradient(Q, [&](double* gradient) {
        if (measure) {
            return std::visit(
                [&](const auto& chosen) {
                    return computed(P, Q, chosen,
                                    [&](const CurveView& p, const CurveView& q, const auto& o,
                                        Control* control) {
                                        return value_and_gradient(o, p, q, gradient, control);
                                    });
                },
                *measure);
        }
        const CurveView p = view(P), q = view(Q);
        return interruptible(static_cast<double>(P.size()), py::none(), [&](Control* control) {
            return sum_of_squares_and_gradient(p, q, gradient, control);
        });
    });
}

// Curves of as many points each, one behind the other.
using CurveBatch = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<CurveView> views(const CurveBatch& batch) {
    std::vector<CurveView> result;
    for (py::ssize_t k = 0; k < batch.shape(0); ++k) {
        result.emplace_back(batch.data(k), batch.shape(1), batch.shape(2));
    }
    return result;
}

// The derivatives of all pairs by one of their curves, if requested.
class BatchGradient {
   public:
    BatchGradient(const CurveBatch& batch, bool is_wanted)
        : pair_(batch.shape(1) * batch.shape(2)) {
        if (!is_wanted) return;
        array_ = py::array_t<double>({batch.shape(0), batch.shape(1), batch.shape(2)});
        data_ = array_->mutable_data();
    }
    double* of_pair(py::ssize_t k) const noexcept {
        return data_ == nullptr ? nullptr : data_ + k * pair_;
    }
    py::object object() const { return array_ ? py::object(*array_) : py::object(py::none()); }

   private:
    py::ssize_t pair_;
    std::optional<py::array_t<double>> array_;
    double* data_ = nullptr;
};

// For the pairs of two batches of shapes (b, n, d) and (b, m, d): values of shape (b,), and the
// requested derivatives by either.
py::tuple gradients_of_pairs(const std::string& name, const CurveBatch& P, const CurveBatch& Q,
                             const py::dict& options, bool by_p, bool by_q, py::ssize_t workers) {
    const DifferentiableMeasure measure = read_differentiable(name, options).value();
    const BatchGradient of_p(P, by_p), of_q(Q, by_q);
    py::array_t<double> values(P.shape(0));
    double* const data = values.mutable_data();
    std::vector<Gradients> out;
    for (py::ssize_t k = 0; k < P.shape(0); ++k) out.push_back({of_p.of_pair(k), of_q.of_pair(k)});
    const std::vector<CurveView> p = views(P), q = views(Q);
    const double work = std::visit(
        [&](const auto& chosen) {
            return static_cast<double>(P.shape(0)) * chosen.work(static_cast<double>(P.shape(1)),
                                                                 static_cast<double>(Q.shape(1)),
                                                                 static_cast<double>(P.shape(2)));
        },
        measure);
    interruptible(static_cast<double>(P.size() + Q.size()) + work, py::none(),
                  [&](Control* control) {
                      values_and_gradients(measure, p, q, data, out, workers, control);
                  });
    return py::make_tuple(values, of_p.object(), of_q.object());
}

// An edit distance as a recurrence, with the data for the estimate of a call's work.
struct EditSteps {
    EditOptions options;
    Recurrence recurrence;
};

EditSteps read_edit_distance(const py::object& name, const py::dict& given) {
    return std::visit(
        [](auto options) -> EditSteps {
            using Options = std::decay_t<decltype(options)>;
            if constexpr (is_edit_distance<Options>) {
                options.cutoff = Options{}.cutoff;
                return {options, options.recurrence()};
            } else {
                throw py::value_error(
                    "edit_path and edit_table are of the edit distances, not of " +
                    std::string(Options::measure));
            }
        },
        read_measure(name, given));
}

py::tuple edit_path(const py::object& name, const CurveArray& P, const CurveArray& Q,
                    const py::dict& given) {
    const EditSteps steps = read_edit_distance(name, given);
    return as_tuple(
        computed(P, Q, steps.options,
                 [&](const CurveView& p, const CurveView& q, const EditOptions&, Control* control) {
                     return warp_path(steps.recurrence, p, q, control);
                 }));
}

py::array_t<double> edit_table(const py::object& name, const CurveArray& P, const CurveArray& Q,
                               const py::dict& given) {
    const EditSteps steps = read_edit_distance(name, given);
    py::array_t<double> out = allocate_table(P, Q);
    double* const data = out.mutable_data();
    computed(P, Q, steps.options,
             [&](const CurveView& p, const CurveView& q, const EditOptions&, Control* control) {
                 warp_table(steps.recurrence, p, q, data, control);
             });
    return out;
}

// The value of two curves in any form; `values` has all options.
template <class Options>
double value_of(const py::object& P, const py::object& Q, const py::tuple& values,
                const py::tuple& defaults) {
    const CurvePair pair(P, Q);
    OwnDistances own(pair.P, pair.Q);
    return computed(pair.P, pair.Q, read_options<Options>(values, defaults, own),
                    [](const CurveView& p, const CurveView& q, const Options& options,
                       Control* control) { return evaluate(options, p, q, control); });
}

void bind_value(py::module_& module, const char* name, decltype(&value_of<DtwOptions>) value,
                const py::tuple& defaults) {
    module.def(
        name, [value, defaults](const py::object& P, const py::object& Q, const py::tuple& values) {
            return value(P, Q, values, defaults);
        });
}

}  // namespace

void bind_measures(py::module_& module) {
    for_each_measure([&](const auto& defaults) {
        using Options = std::decay_t<decltype(defaults)>;
        bind_value(module, Options::measure, value_of<Options>,
                   py::tuple(written(defaults).attr("values")()));
    });
    module.def("area_quads", found<AreaOptions, area_quads>);
    module.def("pcm_match", found<PcmOptions, pcm_match>);
    module.def("closed_dtw", found_number<ClosedOptions, closed_dtw>);
    module.def("closed_dtw_path", found<ClosedOptions, closed_dtw_path>);
    module.def("closed_frechet", found_number<ClosedOptions, closed_frechet>);
    module.def("closed_frechet_path", found<ClosedOptions, closed_frechet_path>);
    module.def("frechet_path", found<FrechetOptions, frechet_path>);
    module.def("dtw_path", found<DtwOptions, dtw_path>);
    module.def("frechet_info", found<FrechetOptions, frechet_info>);
    module.def("dtw_info", found<DtwOptions, dtw_info>);
    module.def("closed_frechet_continuous",
               found_number<FrechetContinuousOptions, closed_frechet_continuous>);
    module.def("closed_frechet_continuous_bounds",
               found<FrechetContinuousOptions, closed_frechet_continuous_bounds>);
    module.def("closed_frechet_continuous_path",
               found<FrechetContinuousOptions, closed_frechet_continuous_path>);
    module.def("frechet_continuous_bounds",
               found<FrechetContinuousOptions, frechet_continuous_bounds>);
    module.def("frechet_continuous_path", found<FrechetContinuousOptions, frechet_continuous_path>);
    module.def("frechet_continuous_part", found<FrechetContinuousOptions, frechet_continuous_part>);
    module.def("hausdorff_continuous_points",
               found<HausdorffContinuousOptions, hausdorff_continuous_points>);
    module.def("common_part", [](const CurveArray& P, const CurveArray& Q, double distance,
                                 const py::dict& options) {
        const auto find = [=](const CurveView& p, const CurveView& q,
                              const CommonPartOptions& given, Control* control) {
            return common_part(p, q, distance, given, control);
        };
        const CommonPart found = computed(P, Q, read_options<CommonPartOptions>(options), find);
        return py::make_tuple(found.length, py::make_tuple(found.p.begin, found.p.end),
                              py::make_tuple(found.q.begin, found.q.end));
    });
    module.def("frechet_within", [](const CurveArray& P, const CurveArray& Q, double distance,
                                    bool continuous) {
        const auto decide = [=](const CurveView& p, const CurveView& q,
                                const FrechetContinuousOptions& /*options*/, Control* control) {
            return frechet_within(p, q, distance, continuous, control);
        };
        return computed(P, Q, FrechetContinuousOptions{}, decide);
    });
    module.def("frechet_table", filled<FrechetOptions, allocate_table, frechet_table>);
    module.def("dtw_table", filled<DtwOptions, allocate_table, dtw_table>);
    module.def("curve_length_residuals",
               filled<CurveLengthOptions, allocate_residuals, curve_length_residuals>);
    module.def("value_and_gradient", gradient_by_name);
    module.def("values_and_gradients", gradients_of_pairs);
    module.def("soft_dtw", found_number<SoftDtwOptions, soft_dtw>);
    module.def("lb_improved", found_number<LowerBoundOptions, lb_improved>);
    module.def("lb_keogh", found_number<LowerBoundOptions, lb_keogh>);
    module.def("lb_kim", found_number<LowerBoundOptions, lb_kim>);
    module.def("edit_path", edit_path);
    module.def("edit_table", edit_table);
}

}  // namespace curvewise::bindings
