// A walk through pairs of vertices, from the first pair to the last, that a radius holds together:
// the greedy filter of Bringmann, Künnemann & Nusser (2019), with a memory of blind alleys. It
// steps along both curves while the next pair is well within the radius, and otherwise to the
// nearest of the next pairs. Where none is free, it goes back a step and remembers the pair. It
// gives up after half as many of these as there are vertices. So it finds nearly every way there is
// on loops, and most on random walks.
//
// A success is certain. Every pair was free, by the filters and exact signs of free_space.hpp. So
// the radius is at least the discrete Fréchet distance. It is at least the continuous one, too:
// both ends of a step are in one cell, whose free space is convex. A failure says nothing.
//
// Time and memory O(n + m): a pair is left backwards at most once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "continuous/boxed_curve.hpp"
#include "continuous/exact_signs.hpp"
#include "continuous/free_space.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::continuous {

// Numbers that are not negative, at most `most` of them.
class NumberSet {
   public:
    explicit NumberSet(std::ptrdiff_t most) noexcept : most_(most) {}

    std::ptrdiff_t size() const noexcept { return count_; }
    bool is_full() const noexcept { return count_ == most_; }
    bool contains(std::ptrdiff_t number) const noexcept {
        return count_ > 0 && slots_[slot_of(number)] != 0;
    }
    // One that it does not contain.
    void insert(std::ptrdiff_t number) {
        if (count_ == 0) make_slots();
        slots_[slot_of(number)] = static_cast<std::uint64_t>(number) + 1;
        ++count_;
    }

   private:
    void make_slots() {
        int bits = 4;
        while ((std::ptrdiff_t{1} << bits) < 2 * most_) ++bits;
        slots_.assign(std::size_t{1} << bits, 0);
        shift_ = 64 - bits;
    }
    // The number's, or the empty one where it would be.
    std::size_t slot_of(std::ptrdiff_t number) const noexcept {
        const std::uint64_t wanted = static_cast<std::uint64_t>(number) + 1;
        std::size_t slot = (wanted * 0x9e3779b97f4a7c15U) >> shift_;
        while (slots_[slot] != 0 && slots_[slot] != wanted) slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }

    std::ptrdiff_t most_;
    std::ptrdiff_t count_ = 0;
    int shift_ = 0;
    runtime::ScratchVector<std::uint64_t> slots_;  // a number plus 1, or 0
};

// The points of a curve, next to each other.
struct Vertices {
    const double* points;
    std::ptrdiff_t size;
    std::ptrdiff_t dim;
};

template <int Dim>
class VertexWalk {
   public:
    struct Pair {
        std::ptrdiff_t i, j;
    };

    // `exact` is of the vertices of q, seen from those of p, in units of the given curves.
    VertexWalk(const Vertices& p, const Vertices& q, const ExactSigns& exact, const Radius& radius)
        : p_(p),
          q_(q),
          exact_(exact),
          radius_(radius),
          dead_(std::min((p.size + q.size) / 2, std::ptrdiff_t{1} << 16)),
          near_(radius.surely_holds(0.8 * radius.square()) ? 0.8 * radius.square() : -1.0) {}

    // Whether the first vertices, or the last, are too far apart.
    bool misses_ends() const {
        const Pair first{0, 0}, last{p_.size - 1, q_.size - 1};
        return !is_free(first, square(first)) || !is_free(last, square(last));
    }
    // Whether it comes from the first pair, which is free, to the last, with at most `most` pairs
    // remembered. Goes on where it gave up. Throws Stopped where the poller says so.
    bool succeeds(runtime::Poller& poller,
                  std::ptrdiff_t most = std::numeric_limits<std::ptrdiff_t>::max()) {
        moves_.reserve(static_cast<std::size_t>(p_.size + q_.size));
        for (std::size_t step = 1; at_.i < p_.size - 1 || at_.j < q_.size - 1; ++step) {
            poller.poll_in_loop(step);
            const Move move = next_move();
            if (move != Move::none) {
                moves_.push_back(move);
                at_ = after(at_, move);
                continue;
            }
            furthest_ = {std::max(furthest_.i, at_.i), std::max(furthest_.j, at_.j)};
            if (moves_.empty() || dead_.is_full() || dead_.size() >= most) return false;
            dead_.insert(number_of(at_));
            const auto last = static_cast<std::ptrdiff_t>(moves_.back());
            moves_.pop_back();
            at_ = {at_.i - last % 2, at_.j - last / 2};
        }
        return true;
    }
    // The largest i and j of pairs from which it had to go back.
    Pair furthest() const noexcept { return furthest_; }

   private:
    enum class Move : unsigned char { none = 0, up = 1, right = 2, both = 3 };

    static Pair after(const Pair& at, Move move) noexcept {
        const auto bits = static_cast<std::ptrdiff_t>(move);
        return {at.i + bits % 2, at.j + bits / 2};
    }
    std::ptrdiff_t number_of(const Pair& pair) const noexcept { return pair.i * q_.size + pair.j; }

    double square(const Pair& pair) const noexcept {
        const std::ptrdiff_t dim = Dim > 0 ? Dim : p_.dim;
        return square_distance<Dim>(p_.points + pair.i * dim, q_.points + pair.j * dim, dim);
    }
    bool is_free(const Pair& pair, double square) const {
        if (radius_.surely_holds(square)) return true;
        if (radius_.surely_misses(square)) return false;
        return radius_.holds(exact_.distance(pair.j, {pair.i, radius_.given()}));
    }

    Move next_move() const {
        const bool has_up = at_.i < p_.size - 1, has_right = at_.j < q_.size - 1;
        double least = std::numeric_limits<double>::infinity();
        Move nearest = Move::none;
        const auto offer = [&](Move move) {
            const Pair to = after(at_, move);
            const double to_square = square(to);
            if (to_square >= least || dead_.contains(number_of(to))) return;
            least = to_square;
            nearest = move;
        };
        if (has_up && has_right) offer(Move::both);
        if (least <= near_) return nearest;
        if (has_up) offer(Move::up);
        if (has_right) offer(Move::right);
        return nearest != Move::none && is_free(after(at_, nearest), least) ? nearest : Move::none;
    }

    Vertices p_, q_;
    ExactSigns exact_;
    Radius radius_;
    NumberSet dead_;  // pairs
    double near_;     // the square of a distance well within the radius
    runtime::ScratchVector<Move> moves_;
    Pair at_{0, 0};
    Pair furthest_{0, 0};
};

}  // namespace curvewise::continuous
