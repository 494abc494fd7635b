/// \file
/// The nearest of many curves, exactly. For each curve of a list, a search finds the k curves of an
/// index with the smallest distances from it, or all within a radius, under any measure.
///
///     const curvewise::Index index(library, curvewise::DtwOptions{});
///     std::vector<double> distances(tests.size() * 5);
///     std::vector<std::int64_t> places(tests.size() * 5);
///     index.kneighbors(tests, 5, distances.data(), places.data(), {-1});  // on all cores
///
/// The answers are bitwise identical to those of cdist and a stable sort, for any number of
/// threads: among equal distances, the earlier curve is the nearer. dtw, frechet and
/// frechet_continuous have lower bounds, which are cheap compared with a distance. From 256 curves
/// on, trees over the first bounds skip most curves that are far. Candidates are tested in the
/// order of their bounds, and each bound is raised before a distance is computed. A bound above the
/// k-th best distance so far ends its pair (the optimal multi-step search of Seidl & Kriegel 1998).
/// A computation ends as soon as the cutoff shows that its distance is larger. Measures without
/// bounds compute every pair, with the cutoff. If all curves have the same number of points, and
/// few, dtw and frechet search for up to 32 curves together: the bounds and the distances of
/// several pairs are computed at once, as in cdist.
///
/// Time: for N curves of n points, a cheap bound of every curve that the trees do not skip, and
/// O(n^2) for each remaining distance. Of 100,000 curves in groups, a few hundred are not skipped;
/// if all first bounds are small, all are. add() takes O(n + log(N)^2) for each curve on average.
/// Memory, relative to that of the points: at most 1.6 times from 32 numbers a curve on, and 1.3
/// times from 128 on. It is about twice for frechet_continuous, and three times for dtw and frechet
/// on the sphere. A removed curve keeps its memory. Any number of threads may
/// call all functions. No search waits for another call: add() and remove() work while searches
/// run, and a search sees the curves that were there when it began.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/measure.hpp"

namespace curvewise {

class Control;

namespace nearest {
struct OpenedIndex;
}

/// A curve of the index, and how far it is.
struct Neighbor {
    std::int64_t index;  ///< of a curve of the index
    double distance;
};

/// Counts of a search, added up over its queries.
struct SearchRecord {
    std::int64_t pairs = 0;
    std::int64_t refined = 0;   ///< of these, pairs whose bound was raised
    std::int64_t computed = 0;  ///< and pairs whose distance was begun
};

/// Options of a search, and of its result.
struct SearchOptions {
    /// Threads for this call, -1 for one per core. Each takes one query at a time. (The `workers`
    /// of the measure are not used.)
    std::ptrdiff_t workers = 1;
    /// Whether the neighbours within a radius come by distance, then index, or by index alone.
    bool sort_results = true;
    /// Whether to compute the distances of the neighbours within a radius. If false, and if they do
    /// not order the result, a distance is nan if the measure has a faster decision.
    bool with_distances = true;
    SearchRecord* record = nullptr;
    /// Receives the index of the curve of each row, if curves of the index are searched for.
    std::vector<std::int64_t>* rows = nullptr;
    /// If curves of the index are searched for: how many curves next to a curve, on either side in
    /// the order in which they were added, are not its neighbours. Rows of kneighbors() without
    /// enough neighbours then end with the index -1 and an infinite distance.
    std::ptrdiff_t exclusion = 0;
};

/// A file that Index::save() has written. Names of files are in UTF-8 on Windows, and as the system
/// has them elsewhere.
class IndexFile {
   public:
    /// Throws std::system_error if the file cannot be opened, and std::runtime_error if it is not
    /// an index, is damaged, or has another format or byte order. Does not read the points.
    CURVEWISE_EXPORT explicit IndexFile(const std::string& path);
    /// The bytes that save() was given.
    CURVEWISE_EXPORT const std::string& note() const noexcept;

   private:
    friend class Index;
    std::shared_ptr<const nearest::OpenedIndex> opened_;
};

/// Curves to search for the nearest of other curves. Curves are numbered in the order in which they
/// are added. This number, their index, never changes, and is not used again after remove().
class Index {
   public:
    /// Owns a copy of the curves. Throws as cdist does, naming the curve (curves[3]).
    CURVEWISE_EXPORT Index(const std::vector<CurveView>& curves, const Measure& measure,
                           Control* control = nullptr);
    /// With the indices of another index, ascending, and its next_index(): a copy of that without
    /// the memory of removed curves.
    CURVEWISE_EXPORT Index(const std::vector<CurveView>& curves, std::vector<std::int64_t> indices,
                           std::int64_t next_index, const Measure& measure,
                           Control* control = nullptr);
    /// The other one is then empty; of its functions all but size(), curves(), indices(),
    /// next_index() and assignment throw std::logic_error.
    CURVEWISE_EXPORT Index(Index&&) noexcept;
    CURVEWISE_EXPORT Index& operator=(Index&&) noexcept;
    Index(const Index&) = delete;
    Index& operator=(const Index&) = delete;
    CURVEWISE_EXPORT ~Index();

    /// Adds all of the curves, or none if it throws. Throws std::logic_error if a Report of a call
    /// of this index calls it, since that call does not see the curves.
    CURVEWISE_EXPORT void add(const std::vector<CurveView>& curves, Control* control = nullptr);
    /// Removes the curves of these indices, or none if it throws: std::invalid_argument for an
    /// index of no curve, of one that was removed, or given twice, and std::logic_error as add().
    /// Later calls do not see the curves. The curves keep their memory.
    CURVEWISE_EXPORT void remove(const std::vector<std::int64_t>& indices);
    /// Writes the curves, without those removed, with their indices, and `note`. The file replaces
    /// another of this name at the end, also one that an index is open on. Throws std::system_error
    /// and Stopped; an older file then stays as it is.
    CURVEWISE_EXPORT void save(const std::string& path, const std::string& note = {},
                               Control* control = nullptr) const;
    /// The index of a file, which is mapped into memory: processes that open it share the points.
    /// The file must not be changed while it is open; save() replaces it. Reads all points once,
    /// and throws as IndexFile does, also for damaged points, and as the constructor does. The file
    /// has the points as the measure of the index that was saved reads them, which are three
    /// layouts. Under a measure of another layout, the index has a copy.
    [[nodiscard]] CURVEWISE_EXPORT static Index open(const std::string& path,
                                                     const Measure& measure,
                                                     Control* control = nullptr);
    [[nodiscard]] CURVEWISE_EXPORT static Index open(const IndexFile& file, const Measure& measure,
                                                     Control* control = nullptr);
    /// The number of curves, without those removed.
    [[nodiscard]] CURVEWISE_EXPORT std::size_t size() const;
    /// Copies of the points, without those removed: valid as long as the index.
    [[nodiscard]] CURVEWISE_EXPORT std::vector<CurveView> curves() const;
    /// The indices of the curves, in ascending order.
    [[nodiscard]] CURVEWISE_EXPORT std::vector<std::int64_t> indices() const;
    /// The index that the next curve will have.
    [[nodiscard]] CURVEWISE_EXPORT std::int64_t next_index() const;

    /// Writes the n_neighbors nearest of X[i] (as P, the curves of the index as Q) to distances[i *
    /// n_neighbors] and indices[i * n_neighbors] on, in ascending order. Throws before any work:
    /// std::invalid_argument as the measure does, with the name of the curve (X[2]), and for an
    /// n_neighbors that is not from 1 to size(). Throws std::bad_alloc and Stopped. Progress counts
    /// every pair, computed or not.
    CURVEWISE_EXPORT void kneighbors(const std::vector<CurveView>& X, std::ptrdiff_t n_neighbors,
                                     double* distances, std::int64_t* indices,
                                     const SearchOptions& options = {},
                                     Control* control = nullptr) const;
    /// The same for every curve of the index, without the curve itself: size() rows in the order of
    /// indices(). No other thread may add or remove curves between size() and this call.
    CURVEWISE_EXPORT void kneighbors(std::ptrdiff_t n_neighbors, double* distances,
                                     std::int64_t* indices, const SearchOptions& options = {},
                                     Control* control = nullptr) const;
    /// The same, where others may: n_neighbors neighbours a row, row after row.
    [[nodiscard]] CURVEWISE_EXPORT std::vector<Neighbor> kneighbors(
        std::ptrdiff_t n_neighbors, const SearchOptions& options = {},
        Control* control = nullptr) const;

    /// All curves whose distance from X[i] is at most `radius`: a number >= 0, except where the
    /// measure may be negative (dtw with own steps of negative weight).
    [[nodiscard]] CURVEWISE_EXPORT std::vector<std::vector<Neighbor>> radius_neighbors(
        const std::vector<CurveView>& X, double radius, const SearchOptions& options = {},
        Control* control = nullptr) const;
    /// Of every curve of the index, without the curve itself, in the order of indices().
    [[nodiscard]] CURVEWISE_EXPORT std::vector<std::vector<Neighbor>> radius_neighbors(
        double radius, const SearchOptions& options = {}, Control* control = nullptr) const;

   private:
    class State;
    struct TakenState {};
    Index(TakenState tag, std::unique_ptr<State> state) noexcept;
    State& state() const;
    std::unique_ptr<State> state_;  // null where moved from
};

}  // namespace curvewise
