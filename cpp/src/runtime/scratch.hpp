// Memory that a thread keeps from one call to the next, so that calls with short curves allocate
// nothing after the first. A block that is given back stays with the thread that gives it, for the
// next block of about its size. So calls within calls (of a Report), exceptions and forks need no
// care: no block has two owners. The system has the memory back when the thread ends.
//
// A thread keeps at most 4 MiB: beyond that it gives all back. It keeps no block above 1 MiB, which
// takes long to fill compared with its allocation.
#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <vector>

namespace curvewise::runtime {

// Aligned as by operator new, and of a size that is rounded up by an eighth at most, or to 64
// bytes. Throws std::bad_alloc.
void* take_scratch(std::size_t bytes);
// With the same number of bytes.
void give_scratch(void* block, std::size_t bytes) noexcept;
// What this thread keeps goes back to the system.
void release_scratch() noexcept;

// The deleter of a block.
class GiveScratch {
   public:
    GiveScratch() noexcept = default;
    explicit GiveScratch(std::size_t bytes) noexcept : bytes_(bytes) {}
    void operator()(void* block) const noexcept { give_scratch(block, bytes_); }

   private:
    std::size_t bytes_ = 0;
};

// Not with address sanitizers, which look for the use of blocks after their end, and not where
// MinGW ends thread-local objects after their memory.
#if defined(__SANITIZE_ADDRESS__) || defined(__MINGW32__)
inline constexpr bool keeps_scratch = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool keeps_scratch = false;
#else
inline constexpr bool keeps_scratch = true;
#endif
#else
inline constexpr bool keeps_scratch = true;
#endif

// Builds for tests fill what is given back, so that a value read before it was written shows.
#ifdef CURVEWISE_FILL_SCRATCH
inline constexpr bool fills_scratch = true;
#else
inline constexpr bool fills_scratch = false;
#endif

// For containers.
template <class T>
class ScratchAllocator {
   public:
    using value_type = T;
    static_assert(alignof(T) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);

    ScratchAllocator() noexcept = default;
    template <class Other>
    ScratchAllocator(const ScratchAllocator<Other>& /*other*/) noexcept {}

    T* allocate(std::size_t count) {
        if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) {
            throw std::bad_array_new_length();
        }
        return static_cast<T*>(take_scratch(count * sizeof(T)));
    }
    void deallocate(T* block, std::size_t count) noexcept {
        give_scratch(block, count * sizeof(T));
    }

    template <class Other>
    bool operator==(const ScratchAllocator<Other>& /*other*/) const noexcept {
        return true;
    }
    template <class Other>
    bool operator!=(const ScratchAllocator<Other>& /*other*/) const noexcept {
        return false;
    }
};

template <class T>
using ScratchVector = std::vector<T, ScratchAllocator<T>>;

// The base of classes whose objects are made one by one.
class InScratch {
   public:
    static void* operator new(std::size_t bytes) { return take_scratch(bytes); }
    static void operator delete(void* block, std::size_t bytes) noexcept {
        give_scratch(block, bytes);
    }

   protected:
    InScratch() = default;
    InScratch(const InScratch&) = default;
    InScratch(InScratch&&) = default;
    InScratch& operator=(const InScratch&) = default;
    InScratch& operator=(InScratch&&) = default;
    ~InScratch() = default;
};

}  // namespace curvewise::runtime
