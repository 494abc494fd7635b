// Several vectors that grow together, or not at all if memory runs out. First, memory is reserved
// in each of them, which may fail. Only then are elements moved, which cannot fail.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <vector>

namespace curvewise::runtime {

// Reserves memory for `more` elements; at least twice the current number, so that many small steps
// stay cheap. An empty vector reserves nothing: move_behind() gives it the other's memory.
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
