// Lists that one thread makes longer while others read them. No element moves or changes, and a
// reader that knows of the first n elements reads nothing that is written later. So readers take no
// lock, once they know n by way of one.
//
// Several lists grow together, or not at all if memory runs out. First, memory is allocated in each
// of them, which may fail. Only then are elements moved there, which cannot fail. Each block of
// memory has at least as many places as all before it, so that there are few blocks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace curvewise::runtime {

template <class T>
class GrowingList {
   public:
    static_assert(std::is_nothrow_move_constructible_v<T>);

    GrowingList() = default;
    GrowingList(const GrowingList&) = delete;
    GrowingList(GrowingList&&) = delete;
    GrowingList& operator=(const GrowingList&) = delete;
    GrowingList& operator=(GrowingList&&) = delete;
    ~GrowingList() { clear(); }

    // For readers. Takes a step for each block before the element, which are at most log2(i) + 1.
    const T& operator[](std::ptrdiff_t i) const noexcept {
        const Block* block = first_.get();
        for (; i >= block->places; block = block->next.get()) i -= block->places;
        return block->elements[i];
    }
    // Calls use(elements, their number) for consecutive parts of the `count` elements from `first`
    // on.
    template <class Use>
    void in_parts(std::ptrdiff_t first, std::ptrdiff_t count, Use&& use) const {
        walk(first, count, [&](const T* elements, std::ptrdiff_t part) { use(elements, part); });
    }

    // For the thread that makes it longer.
    std::ptrdiff_t size() const noexcept { return size_; }
    void make_room(std::ptrdiff_t more) {
        std::ptrdiff_t room = -used_;
        std::unique_ptr<Block>* end = last_ == nullptr ? &first_ : nullptr;
        for (Block* block = last_; block != nullptr; block = block->next.get()) {
            room += block->places;
            end = &block->next;
        }
        if (room >= more) return;
        *end = std::make_unique<Block>(std::max(more - room, size_));
        if (last_ == nullptr) last_ = first_.get();
    }
    // Makes room where there is none.
    void push_back(T element) {
        make_room(1);
        append(std::move(element));
    }
    // Adds all of `others`, for which room was made, and leaves it empty. An empty list needs none:
    // it takes the others' memory.
    void make_room(const GrowingList& others) {
        if (size_ > 0) make_room(others.size_);
    }
    void take(GrowingList& others) noexcept {
        if (size_ == 0) {
            std::swap(first_, others.first_);
            std::swap(last_, others.last_);
            std::swap(used_, others.used_);
            std::swap(size_, others.size_);
            return;
        }
        others.walk(0, others.size_, [this](T* elements, std::ptrdiff_t count) {
            for (std::ptrdiff_t i = 0; i < count; ++i) append(std::move(elements[i]));
        });
        others.clear();
    }
    // Only where no one reads.
    void clear() noexcept {
        walk(0, size_, [](T* elements, std::ptrdiff_t count) { std::destroy_n(elements, count); });
        first_.reset();
        last_ = nullptr;
        used_ = size_ = 0;
    }

   private:
    struct Block {
        explicit Block(std::ptrdiff_t count)
            : places(count), elements(std::allocator<T>().allocate(as_size(count))) {}
        Block(const Block&) = delete;
        Block(Block&&) = delete;
        Block& operator=(const Block&) = delete;
        Block& operator=(Block&&) = delete;
        ~Block() { std::allocator<T>().deallocate(elements, as_size(places)); }

        std::ptrdiff_t places;
        T* elements;
        std::unique_ptr<Block> next;
    };

    static std::size_t as_size(std::ptrdiff_t count) noexcept {
        return static_cast<std::size_t>(count);
    }
    // What is behind the last element that is asked for may be written meanwhile, and is not read.
    template <class Use>
    void walk(std::ptrdiff_t first, std::ptrdiff_t count, Use&& use) const {
        const Block* block = nullptr;
        while (count > 0) {
            block = block == nullptr ? first_.get() : block->next.get();
            const std::ptrdiff_t here = std::min(count, block->places - first);
            if (here > 0) {
                use(block->elements + first, here);
                count -= here;
                first = 0;
            } else {
                first -= block->places;
            }
        }
    }
    // There is room.
    void append(T&& element) noexcept {
        if (used_ == last_->places) {
            last_ = last_->next.get();
            used_ = 0;
        }
        new (last_->elements + used_) T(std::move(element));
        ++used_;
        ++size_;
    }
    std::unique_ptr<Block> first_;
    Block* last_ = nullptr;    // that with elements; there may be empty ones behind it
    std::ptrdiff_t used_ = 0;  // places of that
    std::ptrdiff_t size_ = 0;
};

// Runs of numbers, each in consecutive places.
template <class T>
class GrowingRuns {
   public:
    static_assert(std::is_trivially_copyable_v<T>);

    // For runs of `more` numbers in all.
    void make_room(std::ptrdiff_t more) {
        if (room_ >= more) return;
        const std::ptrdiff_t places = std::max(more, size_);
        blocks_.reserve(blocks_.size() + 1);
        blocks_.emplace_back(new T[static_cast<std::size_t>(places)]);
        next_ = blocks_.back().get();
        room_ = places;
    }
    // A run for which there is room, of any content.
    T* append(std::ptrdiff_t count) noexcept {
        T* const run = next_;
        next_ += count;
        room_ -= count;
        size_ += count;
        return run;
    }
    // Of all runs.
    std::ptrdiff_t size() const noexcept { return size_; }

   private:
    std::vector<std::unique_ptr<T[]>> blocks_;
    T* next_ = nullptr;
    std::ptrdiff_t room_ = 0;
    std::ptrdiff_t size_ = 0;
};

}  // namespace curvewise::runtime
