// Several vectors that grow together, or, where memory runs out, not at all: room is made in each
// of them first, which may fail, and only then are elements moved, which may not.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <vector>

namespace curvewise::runtime {

// Room for `more` elements; at least twice what there is, so that many small steps stay cheap. An
// empty vector needs none: move_behind() gives it the other's.
template <class T>
void make_room(std::vector<T>& to, std::size_t more) {
    if (to.empty()) return;
    const std::size_t wanted = to.size() + more;
    if (wanted > to.capacity()) to.reserve(std::max(wanted, 2 * to.capacity()));
}

// Moves all elements of `from`, for which there is room, to the end of `to`.
template <class T>
void move_behind(std::vector<T>& to, std::vector<T>& from) noexcept {
    static_assert(std::is_nothrow_move_constructible_v<T>);
    if (to.empty()) return to.swap(from);
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    from.clear();
}

}  // namespace curvewise::runtime
