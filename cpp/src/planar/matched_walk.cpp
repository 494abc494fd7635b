#include "planar/matched_walk.hpp"

#include <limits>

namespace curvewise::planar {

const VerticesAhead::Vertex* VerticesAhead::read(const Vertex* next) noexcept {
    index_ += next - this->next();
    while (positions_[index_] < static_cast<double>(first_sample_)) ++index_;
    const auto vertex = [&](std::ptrdiff_t index, double place) -> Vertex {
        return {place, positions_[index], {points_[2 * index], points_[2 * index + 1]}};
    };
    for (std::ptrdiff_t k = 1; k <= before; ++k) {
        vertices_[static_cast<std::size_t>(before - k)] =
            vertex(std::max<std::ptrdiff_t>(index_ - k, 0), 0.0);
    }
    Vertex* to = vertices_.data() + before;
    const Vertex* const end = to + most;
    std::ptrdiff_t index = index_;
    for (; to != end && positions_[index] < end_sample_; ++to, ++index) {
        // A point at a sample is at the place of a cell.
        const auto sample = static_cast<std::int64_t>(positions_[index]);
        const Passage& passage = passages_[static_cast<std::size_t>(sample - first_sample_)];
        const double behind = positions_[index] - static_cast<double>(sample);
        *to = vertex(index, passage.begin + behind * passage.rate);
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    last_place_ = to == end ? end[-1].place : infinity;
    *to = vertex(index, infinity);
    return this->next();
}

bool StepsAhead::read(VerticesAhead& of_p, VerticesAhead& of_q) noexcept {
    constexpr auto most = static_cast<std::size_t>(VerticesAhead::most_steps);
    const std::size_t first = cell_, last = std::min(first + most, cells_.size() - 1);
    of_p.begin(cells_[first][0], cells_[last][0]);
    of_q.begin(cells_[first][1], cells_[last][1]);
    count_ = 0;
    for (; cell_ < last; ++cell_) {
        const auto [i, j] = cells_[cell_];
        const auto [next_i, next_j] = cells_[cell_ + 1];
        const auto begin = static_cast<double>(i + j);
        const auto rate = static_cast<double>(next_i + next_j - i - j);
        if (i < next_i) of_p.pass(i, {begin, rate});
        if (j < next_j) of_q.pass(j, {begin, rate});
        Step step{begin + rate,
                  begin,
                  static_cast<double>(i),
                  static_cast<double>(j),
                  static_cast<double>(next_i - i) / rate,
                  static_cast<double>(next_j - j) / rate};
        if (end_of_piece_ <= begin) end_of_piece_ += places_per_piece_;
        if (end_of_piece_ < step.end) {
            steps_[count_] = step;
            steps_[count_++].end = end_of_piece_;
        }
        steps_[count_++] = step;
    }
    return count_ > 0;
}

}  // namespace curvewise::planar
