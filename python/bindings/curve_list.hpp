// A Python list of arrays as a list of views.
#pragma once

#include <algorithm>
#include <vector>

#include "numpy_view.hpp"

namespace curvewise::bindings {

// The arrays that a list of curves looks at, and the views.
struct Curves {
    explicit Curves(const py::list& list) {
        arrays.reserve(list.size());
        views.reserve(list.size());
        for (const py::handle& item : list) {
            arrays.push_back(py::reinterpret_borrow<py::object>(item));
            views.push_back(listed_view(arrays.back()));
        }
    }

    // The largest curve.
    double longest() const noexcept {
        double most = 0.0;
        for (const CurveView& curve : views)
            most = std::max(most, static_cast<double>(curve.size()));
        return most;
    }
    double dim() const noexcept {
        return views.empty() ? 0.0 : static_cast<double>(views.front().dim());
    }
    double size() const noexcept { return static_cast<double>(views.size()); }
    // The entries that a check of the curves reads, at least a few for each curve.
    double entries() const noexcept { return size() * (10.0 + longest() * dim()); }

    std::vector<py::object> arrays;
    std::vector<CurveView> views;
};

}  // namespace curvewise::bindings
