// The index of many curves, runs of a long curve, and the mean: arrays in, arrays out.
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "bind_topics.hpp"
#include "curve_list.hpp"
#include "curvewise/dtw_mean.hpp"
#include "curvewise/matrix_profile.hpp"
#include "curvewise/nearest.hpp"
#include "curvewise/subsequence.hpp"
#include "interruptible.hpp"
#include "options.hpp"

namespace curvewise::bindings {
namespace {

using Numbers = py::array_t<double>;
using Places = py::array_t<std::int64_t>;

template <class T>
py::array_t<T> as_array(const std::vector<T>& values) {
    return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::tuple counts_of(const SearchRecord& record) {
    return py::make_tuple(record.pairs, record.refined, record.computed);
}

// Calls function(). Errors of the system become OSError, and files that are no index ValueError.
template <class Function>
auto with_file_errors(Function function) {
    try {
        return function();
    } catch (const Stopped&) {
        throw;
    } catch (const std::system_error& error) {
        PyErr_SetObject(PyExc_OSError, py::make_tuple(error.code().value(), error.what()).ptr());
        throw py::error_already_set();
    } catch (const std::runtime_error& error) {
        throw py::value_error(error.what());
    }
}

class BoundIndex {
   public:
    BoundIndex(const py::list& curves, const py::object& name, const py::dict& options)
        : measure_(read_measure(name, options)),
          index_(make(curves, [&](const auto& views, Control* control) {
              return Index(views, measure_, control);
          })) {}
    // With the indices of the curves in another, and that of the next.
    BoundIndex(const py::list& curves, const std::vector<std::int64_t>& indices,
               std::int64_t next_index, const py::object& name, const py::dict& options)
        : measure_(read_measure(name, options)),
          index_(make(curves, [&](const auto& views, Control* control) {
              return Index(views, indices, next_index, measure_, control);
          })) {}

    void add(const py::list& curves) {
        const Curves added(curves);
        interruptible(reading(added), py::none(),
                      [&](Control* control) { index_.add(added.views, control); });
        note_longest(added);
    }
    BoundIndex(const IndexFile& file, const py::object& name, const py::dict& options)
        : measure_(read_measure(name, options)), index_(with_file_errors([&] {
              return interruptible(steps_worth_watching, py::none(), [&](Control* control) {
                  return Index::open(file, measure_, control);
              });
          })) {
        for (const CurveView& curve : index_.curves()) {
            longest_ = std::max(longest_.load(), static_cast<double>(curve.size()));
            dim_ = static_cast<double>(curve.dim());
        }
    }

    void save(const std::string& path, const std::string& note) const {
        with_file_errors([&] {
            interruptible(steps_worth_watching, py::none(),
                          [&](Control* control) { index_.save(path, note, control); });
        });
    }
    void remove(const std::vector<std::int64_t>& indices) { index_.remove(indices); }
    std::size_t size() const { return index_.size(); }
    std::int64_t next_index() const { return index_.next_index(); }
    Places indices() const { return as_array(index_.indices()); }
    py::list curves() const {
        py::list arrays;
        for (const CurveView& curve : index_.curves()) {
            Numbers array =
                curve.is_flat() ? Numbers(curve.size()) : Numbers({curve.size(), curve.dim()});
            double* to = array.mutable_data();
            for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
                for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) *to++ = curve(i, c);
            }
            arrays.append(std::move(array));
        }
        return arrays;
    }

    // X is a list, or None for the curves of the index, whose indices are then the fourth result.
    // `exclusion` is of these.
    py::tuple kneighbors(const py::object& X, std::ptrdiff_t count, const py::object& workers,
                         const py::object& progress, std::ptrdiff_t exclusion) const {
        if (X.is_none()) return neighbors_of_own(count, workers, progress, exclusion);
        SearchRecord record;
        const SearchOptions options = search_options(workers, true, true, record);
        const Curves queries(X.cast<py::list>());
        const auto rows = static_cast<py::ssize_t>(queries.views.size());
        const auto columns = std::max<std::ptrdiff_t>(count, 0);
        Numbers distances({rows, columns});
        Places indices({rows, columns});
        double* const to_distances = distances.mutable_data();
        std::int64_t* const to_indices = indices.mutable_data();
        interruptible(work(&queries), progress, [&](Control* control) {
            index_.kneighbors(queries.views, count, to_distances, to_indices, options, control);
        });
        return py::make_tuple(distances, indices, counts_of(record), py::none());
    }

    // The neighbours of all queries, one query's behind the other's, and where each query's begin.
    py::tuple radius_neighbors(const py::object& X, double radius, bool sort_results,
                               bool with_distances, const py::object& workers,
                               const py::object& progress) const {
        SearchRecord record;
        std::vector<std::int64_t> rows;
        SearchOptions options = search_options(workers, sort_results, with_distances, record);
        options.rows = &rows;
        std::optional<Curves> queries;
        if (!X.is_none()) queries.emplace(X.cast<py::list>());
        const Curves* const asked = queries ? &*queries : nullptr;
        const auto found = interruptible(work(asked), progress, [&](Control* control) {
            return queries ? index_.radius_neighbors(queries->views, radius, options, control)
                           : index_.radius_neighbors(radius, options, control);
        });
        std::vector<std::int64_t> begins{0}, indices;
        std::vector<double> distances;
        for (const std::vector<Neighbor>& neighbors : found) {
            for (const Neighbor& neighbor : neighbors) {
                indices.push_back(neighbor.index);
                distances.push_back(neighbor.distance);
            }
            begins.push_back(static_cast<std::int64_t>(indices.size()));
        }
        return py::make_tuple(as_array(distances), as_array(indices), as_array(begins),
                              counts_of(record), queries ? py::object(py::none()) : as_array(rows));
    }

   private:
    template <class Make>
    Index make(const py::list& list, Make make) {
        const Curves curves(list);
        note_longest(curves);
        return interruptible(reading(curves), py::none(),
                             [&](Control* control) { return make(curves.views, control); });
    }

    // Other threads may add curves, or remove some, before the search sees how many there are.
    py::tuple neighbors_of_own(std::ptrdiff_t count, const py::object& workers,
                               const py::object& progress, std::ptrdiff_t exclusion) const {
        SearchRecord record;
        std::vector<std::int64_t> rows;
        SearchOptions options = search_options(workers, true, true, record);
        options.rows = &rows;
        options.exclusion = exclusion;
        const auto found = interruptible(work(nullptr), progress, [&](Control* control) {
            return index_.kneighbors(count, options, control);
        });
        const auto size = static_cast<py::ssize_t>(rows.size());
        Numbers distances({size, count});
        Places indices({size, count});
        double* to_distance = distances.mutable_data();
        std::int64_t* to_index = indices.mutable_data();
        for (const Neighbor& neighbor : found) {
            *to_distance++ = neighbor.distance;
            *to_index++ = neighbor.index;
        }
        return py::make_tuple(distances, indices, counts_of(record), as_array(rows));
    }

    // The elementary steps that copying and preparing curves takes, roughly.
    static double reading(const Curves& curves) noexcept {
        return 10.0 * curves.size() * curves.longest() * curves.dim();
    }

    void note_longest(const Curves& curves) noexcept {
        longest_ = std::max(longest_.load(), curves.longest());
        dim_ = std::max(dim_.load(), curves.dim());
    }

    static SearchOptions search_options(const py::object& workers, bool sort_results,
                                        bool with_distances, SearchRecord& record) {
        return {whole_number("workers", workers, workers_range),
                sort_results,
                with_distances,
                &record,
                nullptr,
                0};
    }

    // An upper bound of the elementary steps ahead, and enough to be called without the lock.
    double work(const Curves* queries) const {
        const auto count = static_cast<double>(size());
        const double rows = queries ? queries->size() : count;
        const double n = queries ? queries->longest() : longest_.load();
        const double pair = std::visit(
            [&](const auto& options) { return options.work(n, longest_, dim_); }, measure_);
        return std::max(rows * count * pair, steps_worth_unlocking);
    }

    std::atomic<double> longest_{0.0};  // of all curves
    std::atomic<double> dim_{0.0};
    Measure measure_;
    Index index_;
};

// A list of (distance, start, stop).
template <class Options>
py::list found_subsequences(const CurveArray& P, const CurveArray& Q, std::ptrdiff_t count,
                            const py::dict& given) {
    const auto options = read_options<Options>(given);
    const CurveView p = view(P), q = view(Q);
    const double work = options.work(static_cast<double>(p.size()), static_cast<double>(q.size()),
                                     static_cast<double>(p.dim()));
    const std::vector<Subsequence> found = interruptible(work, py::none(), [&](Control* control) {
        return subsequences(p, q, count, options, control);
    });
    py::list list;
    for (const Subsequence& one : found) {
        list.append(py::make_tuple(one.distance, one.start, one.stop));
    }
    return list;
}

// The totals of runs, and (d, runs) scales. `Q` is a part of a curve, some milliseconds' work.
py::tuple found_outside(const CurveArray& low, const CurveArray& high, const CurveArray& Q,
                        const py::dict& given, bool of_largest) {
    const Metric metric = read_options<FrechetOptions>(given).ground.metric;
    const RunsOutside found = runs_outside(view(low), view(high), view(Q), metric, of_largest);
    const auto count = static_cast<py::ssize_t>(found.totals.size());
    return py::make_tuple(as_array(found.totals),
                          Numbers({Q.shape(1), count}, found.scales.data()));
}

// Distances and indices.
py::tuple found_profile(const CurveArray& record, const CurveArray& means,
                        const CurveArray& deviations, std::ptrdiff_t exclusion,
                        const py::object& workers) {
    const std::ptrdiff_t threads = whole_number("workers", workers, workers_range);
    const CurveView x = view(record), m = view(means), s = view(deviations);
    const auto count = static_cast<double>(m.size());
    const MatrixProfile found = interruptible(
        count * count * static_cast<double>(x.dim()), py::none(),
        [&](Control* control) { return matrix_profile(x, m, s, exclusion, threads, control); });
    return py::make_tuple(as_array(found.distances), as_array(found.indices));
}

py::tuple found_mean(const py::list& list, const std::vector<double>& weights,
                     const CurveArray& initial, const py::object& window, const py::object& rounds,
                     double tolerance, const py::object& workers, const py::object& progress) {
    DtwMeanOptions options;
    options.window_fraction = proper_fraction(window);
    if (!window.is_none() && !options.window_fraction) {
        options.window = whole_number("window", window, window_range);
    }
    options.iterations = whole_number("iterations", rounds, {0, "give a whole number >= 0"});
    options.tolerance = tolerance;
    options.workers = whole_number("workers", workers, workers_range);
    const Curves curves(list);
    const CurveView start = view(initial);
    const double work = curves.size() * curves.longest() * static_cast<double>(start.size());
    const DtwMean mean = interruptible(work, progress, [&](Control* control) {
        return dtw_mean(curves.views, weights, start, options, control);
    });
    Numbers points = start.is_flat() ? Numbers(start.size()) : Numbers({start.size(), start.dim()});
    std::copy(mean.points.begin(), mean.points.end(), points.mutable_data());
    return py::make_tuple(points, as_array(mean.costs), mean.converged);
}

}  // namespace

void bind_nearest(py::module_& module) {
    py::class_<IndexFile>(module, "IndexFile")
        .def(py::init([](const std::string& path) {
            return with_file_errors([&] { return IndexFile(path); });
        }))
        .def("note", [](const IndexFile& file) { return py::bytes(file.note()); });
    py::class_<BoundIndex>(module, "Index")
        .def(py::init<const py::list&, const py::object&, const py::dict&>())
        .def(py::init<const py::list&, const std::vector<std::int64_t>&, std::int64_t,
                      const py::object&, const py::dict&>())
        .def(py::init<const IndexFile&, const py::object&, const py::dict&>())
        .def("add", &BoundIndex::add)
        .def("save", &BoundIndex::save)
        .def("remove", &BoundIndex::remove)
        .def("size", &BoundIndex::size)
        .def("next_index", &BoundIndex::next_index)
        .def("indices", &BoundIndex::indices)
        .def("curves", &BoundIndex::curves)
        .def("kneighbors", &BoundIndex::kneighbors)
        .def("radius_neighbors", &BoundIndex::radius_neighbors);
    module.def("dtw_subsequences", found_subsequences<DtwOptions>);
    module.def("frechet_subsequences", found_subsequences<FrechetOptions>);
    module.def("runs_outside", found_outside);
    module.def("matrix_profile", found_profile);
    module.def("dtw_mean", found_mean);
}

}  // namespace curvewise::bindings
