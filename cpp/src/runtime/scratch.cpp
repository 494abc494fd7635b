#include "runtime/scratch.hpp"

#include <array>
#include <cstring>
#include <new>
#include <utility>

namespace curvewise::runtime {
namespace {

constexpr std::size_t most_in_a_thread = std::size_t{1} << 22;

// Sizes from `most` of the sizes before on, in steps of 2^shift.
struct Steps {
    std::size_t most;  // bytes
    unsigned shift;
    std::size_t first_list;
};
constexpr std::array<Steps, 4> steps{{{std::size_t{1} << 12, 6, 0},
                                      {std::size_t{1} << 15, 9, 64 - 8},
                                      {std::size_t{1} << 18, 12, 120 - 8},
                                      {std::size_t{1} << 20, 15, 176 - 8}}};
constexpr std::size_t lists = 200;

// The list that blocks for these bytes are in, and their size. Larger ones are in none.
struct Place {
    std::size_t list;
    std::size_t bytes;
};
constexpr Place place_of(std::size_t bytes) noexcept {
    const std::size_t last = bytes - (bytes > 0 ? 1 : 0);
    for (const Steps& step : steps) {
        if (last < step.most) {
            const std::size_t number = last >> step.shift;
            return {step.first_list + number, (number + 1) << step.shift};
        }
    }
    return {lists, bytes};
}
static_assert(place_of(std::size_t{1} << 12).list == 63);
static_assert(place_of((std::size_t{1} << 12) + 1).list == 64);
static_assert(place_of(std::size_t{1} << 20).list == lists - 1);

class Kept {
   public:
    Kept() = default;
    Kept(const Kept&) = delete;
    Kept(Kept&&) = delete;
    Kept& operator=(const Kept&) = delete;
    Kept& operator=(Kept&&) = delete;
    ~Kept() { release(); }

    void* take(const Place& place) noexcept {
        Block* const block = first_[place.list];
        if (block != nullptr) {
            first_[place.list] = block->next;
            bytes_ -= place.bytes;
        }
        return block;
    }
    void give(void* data, const Place& place) noexcept {
        if (bytes_ + place.bytes > most_in_a_thread) release();
        first_[place.list] = new (data) Block{first_[place.list]};
        bytes_ += place.bytes;
    }
    void release() noexcept {
        for (Block*& first : first_) {
            while (first != nullptr) {
                Block* const next = first->next;
                ::operator delete(first);
                first = next;
            }
        }
        bytes_ = 0;
    }

   private:
    struct Block {
        Block* next;
    };
    std::array<Block*, lists> first_{};
    std::size_t bytes_ = 0;
};

// These two have no destructors, so that they may be read until the thread is gone: objects that
// end after Owner still give their memory back.
thread_local Kept* kept = nullptr;
thread_local bool has_ended = false;

struct Owner {
    Owner() noexcept = default;
    Owner(const Owner&) = delete;
    Owner(Owner&&) = delete;
    Owner& operator=(const Owner&) = delete;
    Owner& operator=(Owner&&) = delete;
    ~Owner() {
        has_ended = true;
        delete std::exchange(kept, nullptr);
    }
    void own() noexcept {}  // from here on this thread has one
};

Kept* kept_by_thread() {
    if (kept != nullptr || !keeps_scratch || has_ended) return kept;
    thread_local Owner owner;
    owner.own();
    kept = new Kept;
    return kept;
}

}  // namespace

void* take_scratch(std::size_t bytes) {
    const Place place = place_of(bytes);
    if (place.list < lists) {
        Kept* const own = kept_by_thread();
        void* const block = own == nullptr ? nullptr : own->take(place);
        if (block != nullptr) return block;
    }
    return ::operator new(place.bytes);
}

void give_scratch(void* block, std::size_t bytes) noexcept {
    const Place place = place_of(bytes);
    // As a double -5e303, which wins every minimum.
    if (fills_scratch) std::memset(block, 0xfe, bytes);
    if (place.list < lists && kept != nullptr) {
        kept->give(block, place);
    } else {
        ::operator delete(block);
    }
}

void release_scratch() noexcept {
    if (kept != nullptr) kept->release();
}

}  // namespace curvewise::runtime
