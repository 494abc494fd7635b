#include "nearest/index_checks.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "curves/owned_curve.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::nearest {

CheckedCurve IndexChecks::curve(const CurveView& curve, std::string name, Poller& poller) const {
    return curves::checked_listed(curve, std::move(name), poller,
                                  measure_.requirements().on_sphere);
}

Queries IndexChecks::queries(const std::vector<CurveView>* X, const IndexView& view,
                             Poller& poller) const {
    Queries queries;
    if (X == nullptr) {
        queries.targets = view.targets();
        queries.curves.reserve(queries.targets.size());
        for (const std::ptrdiff_t j : queries.targets) {
            poller.poll_in_loop(static_cast<std::size_t>(j));
            queries.curves.push_back(targets_.curve(j));
            // It may have been added behind others.
            queries.curves.back().name = "curves[" + std::to_string(indices_[j]) + "]";
        }
    } else {
        const curves::CurveList list(*X, "X");
        check_like_first(list, view);
        queries.curves.reserve(X->size());
        for (std::size_t i = 0; i < X->size(); ++i) {
            queries.curves.push_back(curve(list[i], list.name_of(i), poller));
        }
    }
    check_targets(queries, view, poller);
    return queries;
}

// Whether each has a value with the curves of the view.
void IndexChecks::check_targets(const Queries& queries, const IndexView& view,
                                Poller& poller) const {
    runtime::ScratchVector<std::ptrdiff_t> sizes;
    for (const CheckedCurve& P : queries.curves) {
        const std::ptrdiff_t n = P.curve.size();
        if (sizes.empty() || sizes.back() != n) sizes.push_back(n);
        targets_.check(P, poller);
    }
    std::sort(sizes.begin(), sizes.end());
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    for (const std::ptrdiff_t n : sizes) {
        for (const std::ptrdiff_t m : *view.sizes) measure_.check_sizes(n, m);
    }
}

void IndexChecks::check_like_first(const curves::CurveList& list, const IndexView& view) const {
    if (view.seen.size == 0) {
        check_shapes(measure_.requirements(), list);
    } else {
        const CurveView first = targets_.curve(0).curve;
        char name[48];  // not a string, which would allocate
        std::snprintf(name, sizeof name, "curve %lld of the index",
                      static_cast<long long>(indices_[0]));
        check_shapes(measure_.requirements(), {first, name}, list);
    }
}

void check_count(std::ptrdiff_t count, std::ptrdiff_t size, bool leaves_itself_out) {
    const std::ptrdiff_t most = size - (leaves_itself_out ? 1 : 0);
    if (count >= 1 && count <= most) return;
    throw std::invalid_argument(
        "n_neighbors is " + std::to_string(count) + "; give a whole number from 1 to " +
        std::to_string(most) +
        (leaves_itself_out ? ", the other curves of the index" : ", the curves of the index"));
}

}  // namespace curvewise::nearest
