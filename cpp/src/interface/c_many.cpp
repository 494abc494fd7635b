// The C interface: many curves.
#include <algorithm>

#include "interface/c_translate.hpp"

struct curvewise_prepared {
    curvewise::Prepared prepared;
};

struct curvewise_index {
    curvewise::Index index;
};

namespace {

using curvewise::BatchOptions;
using curvewise::Control;
using curvewise::CurveView;
using curvewise::c::at;
using curvewise::c::complete;
using curvewise::c::control_of;
using curvewise::c::guarded;
using curvewise::c::measure_of;
using curvewise::c::require;
using curvewise::c::views;

// How a batch is run, and what watches it.
struct Run {
    explicit Run(const curvewise_batch_options* given) : Run(complete(given)) {}

    BatchOptions options;
    Control* control;

   private:
    explicit Run(const curvewise_batch_options& given)
        : options{given.workers, given.cutoff}, control(control_of(given.control)) {}
};

curvewise::SearchOptions translate(const curvewise_search_options& given) {
    curvewise::SearchOptions options;
    options.workers = given.workers;
    options.sort_results = given.sort_results != 0;
    options.with_distances = given.with_distances != 0;
    return options;
}

}  // namespace

int curvewise_cdist(const curvewise_curve* XA, ptrdiff_t na, const curvewise_curve* XB,
                    ptrdiff_t nb, int measure, const void* options,
                    const curvewise_batch_options* batch, double* out, curvewise_error* error) {
    return guarded(error, [&] {
        const std::vector<CurveView> a = views(XA, na, "XA"), b = views(XB, nb, "XB");
        if (!a.empty() && !b.empty()) require(out, "out");
        const Run run(batch);
        curvewise::cdist(a, b, measure_of(measure, options).measure, out, run.options, run.control);
    });
}

int curvewise_pdist(const curvewise_curve* X, ptrdiff_t k, int measure, const void* options,
                    const curvewise_batch_options* batch, double* out, curvewise_error* error) {
    return guarded(error, [&] {
        const std::vector<CurveView> curves = views(X, k, "X");
        if (k > 1) require(out, "out");
        const Run run(batch);
        curvewise::pdist(curves, measure_of(measure, options).measure, out, run.options,
                         run.control);
    });
}

int curvewise_prepared_create(const curvewise_curve* P, int measure, const void* options,
                              curvewise_prepared** prepared, curvewise_error* error) {
    return guarded(error, [&] {
        curvewise_prepared*& created = at(prepared, "prepared");
        const auto [chosen, control] = measure_of(measure, options);
        created = new curvewise_prepared{{curvewise::c::view(P, "P"), chosen, control}};
    });
}

void curvewise_prepared_destroy(curvewise_prepared* prepared) { delete prepared; }

int curvewise_prepared_value(const curvewise_prepared* prepared, const curvewise_curve* Q,
                             const curvewise_batch_options* batch, double* value,
                             curvewise_error* error) {
    return guarded(error, [&] {
        const curvewise::Prepared& P = at(prepared, "prepared").prepared;
        double& out = at(value, "value");
        const CurveView view = curvewise::c::view(Q, "Q");
        const Run run(batch);
        out = P(view, run.options, run.control);
    });
}

int curvewise_prepared_values(const curvewise_prepared* prepared, const curvewise_curve* Q,
                              ptrdiff_t count, const curvewise_batch_options* batch, double* out,
                              curvewise_error* error) {
    return guarded(error, [&] {
        const curvewise::Prepared& P = at(prepared, "prepared").prepared;
        const std::vector<CurveView> curves = views(Q, count, "Q");
        if (count > 0) require(out, "out");
        const Run run(batch);
        P(curves, out, run.options, run.control);
    });
}

int curvewise_index_create(const curvewise_curve* curves, ptrdiff_t count, int measure,
                           const void* options, curvewise_control* control, curvewise_index** index,
                           curvewise_error* error) {
    return guarded(error, [&] {
        curvewise_index*& created = at(index, "index");
        created = new curvewise_index{{views(curves, count, "curves"),
                                       measure_of(measure, options).measure, control_of(control)}};
    });
}

void curvewise_index_destroy(curvewise_index* index) { delete index; }

int curvewise_index_add(curvewise_index* index, const curvewise_curve* curves, ptrdiff_t count,
                        curvewise_control* control, curvewise_error* error) {
    return guarded(error, [&] {
        at(index, "index").index.add(views(curves, count, "curves"), control_of(control));
    });
}

int curvewise_index_remove(curvewise_index* index, const int64_t* indices, ptrdiff_t count,
                           curvewise_error* error) {
    return guarded(error, [&] {
        curvewise::Index& changed = at(index, "index").index;
        curvewise::c::check_count(count, "indices");
        if (count > 0) require(indices, "indices");
        changed.remove({indices, indices + count});
    });
}

ptrdiff_t curvewise_index_size(const curvewise_index* index) {
    return index == nullptr ? 0 : static_cast<ptrdiff_t>(index->index.size());
}

int curvewise_index_indices(const curvewise_index* index, int64_t* indices, ptrdiff_t capacity,
                            ptrdiff_t* count, curvewise_error* error) {
    return guarded(error, [&] {
        const std::vector<int64_t> present = at(index, "index").index.indices();
        curvewise::c::write_count(present.size(), capacity, at(count, "count"));
        if (!present.empty()) require(indices, "indices");
        std::copy(present.begin(), present.end(), indices);
    });
}

int curvewise_index_save(const curvewise_index* index, const char* path, curvewise_control* control,
                         curvewise_error* error) {
    return guarded(error, [&] {
        require(path, "path");
        at(index, "index").index.save(path, {}, control_of(control));
    });
}

int curvewise_index_open(const char* path, int measure, const void* options,
                         curvewise_control* control, curvewise_index** index,
                         curvewise_error* error) {
    return guarded(error, [&] {
        curvewise_index*& opened = at(index, "index");
        require(path, "path");
        opened = new curvewise_index{curvewise::Index::open(
            path, measure_of(measure, options).measure, control_of(control))};
    });
}

int curvewise_index_kneighbors(const curvewise_index* index, const curvewise_curve* X,
                               ptrdiff_t count, ptrdiff_t n_neighbors,
                               const curvewise_search_options* options, double* distances,
                               int64_t* indices, curvewise_error* error) {
    return guarded(error, [&] {
        const curvewise::Index& searched = at(index, "index").index;
        const std::vector<CurveView> queries = views(X, count, "X");
        if (count > 0) require(distances, "distances"), require(indices, "indices");
        const curvewise_search_options given = complete(options);
        searched.kneighbors(queries, n_neighbors, distances, indices, translate(given),
                            control_of(given.control));
    });
}

int curvewise_index_radius_neighbors(const curvewise_index* index, const curvewise_curve* X,
                                     ptrdiff_t count, double radius,
                                     const curvewise_search_options* options, ptrdiff_t* starts,
                                     double* distances, int64_t* indices, ptrdiff_t capacity,
                                     curvewise_error* error) {
    return guarded(error, [&] {
        const curvewise::Index& searched = at(index, "index").index;
        const std::vector<CurveView> queries = views(X, count, "X");
        require(starts, "starts");
        const curvewise_search_options given = complete(options);
        const auto found =
            searched.radius_neighbors(queries, radius, translate(given), control_of(given.control));
        starts[0] = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            starts[i + 1] = starts[i] + static_cast<ptrdiff_t>(found[i].size());
        }
        if (indices == nullptr) return;
        ptrdiff_t all = 0;
        curvewise::c::write_count(static_cast<std::size_t>(starts[count]), capacity, all);
        for (const auto& neighbors : found) {
            for (const curvewise::Neighbor& near : neighbors) {
                *indices++ = near.index;
                if (distances != nullptr) *distances++ = near.distance;
            }
        }
    });
}
