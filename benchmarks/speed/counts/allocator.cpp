// The heap of a program that is counted, preloaded by counts.py: a block is a power of two of
// bytes, and a free one stands in the list of its size. Allocating and freeing take the same few
// instructions whatever was allocated before, where the C library's take some hundred more or less
// as soon as a block is larger than a kilobyte. No memory is given back to the system.
#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace {

constexpr std::size_t page_run = std::size_t{1} << 24;

struct Free {
    Free* next;
};

// In front of what a caller gets.
struct alignas(16) Header {
    Free* block;
    std::size_t exponent;
};

std::atomic_flag taken = ATOMIC_FLAG_INIT;
Free* lists[64];
std::byte* fresh = nullptr;
std::size_t fresh_size = 0;

std::byte* from_system(std::size_t size) noexcept {
    void* const found =
        mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return found == MAP_FAILED ? nullptr : static_cast<std::byte*>(found);
}

Free* new_block(std::size_t size) noexcept {
    if (size >= page_run) return reinterpret_cast<Free*>(from_system(size));
    if (size > fresh_size) {
        fresh = from_system(page_run);
        fresh_size = fresh == nullptr ? 0 : page_run;
        if (fresh == nullptr) return nullptr;
    }
    fresh_size -= size;
    return reinterpret_cast<Free*>(fresh + fresh_size);
}

void* allocate(std::size_t size, std::size_t wanted_alignment) noexcept {
    const std::size_t alignment = std::max(wanted_alignment, alignof(Header));
    const std::size_t whole = size + sizeof(Header) + alignment;
    if (whole < size || whole > std::size_t{1} << 46) {
        errno = ENOMEM;
        return nullptr;
    }
    const auto exponent = static_cast<std::size_t>(64 - __builtin_clzll(whole - 1));
    while (taken.test_and_set(std::memory_order_acquire)) {
    }
    Free* const block = lists[exponent];
    Free* const found = block != nullptr ? block : new_block(std::size_t{1} << exponent);
    if (block != nullptr) lists[exponent] = block->next;
    taken.clear(std::memory_order_release);
    if (found == nullptr) {
        errno = ENOMEM;
        return nullptr;
    }
    const auto first = reinterpret_cast<std::uintptr_t>(found) + sizeof(Header);
    const std::uintptr_t place = (first + alignment - 1) / alignment * alignment;
    *(reinterpret_cast<Header*>(place) - 1) = {found, exponent};
    return reinterpret_cast<void*>(place);
}

const Header& header_of(void* data) noexcept { return *(static_cast<Header*>(data) - 1); }

std::size_t room_of(void* data) noexcept {
    const Header& header = header_of(data);
    const auto end =
        reinterpret_cast<std::uintptr_t>(header.block) + (std::size_t{1} << header.exponent);
    return end - reinterpret_cast<std::uintptr_t>(data);
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) { return allocate(size, 1); }

void free(void* data) {
    if (data == nullptr) return;
    const Header header = header_of(data);
    while (taken.test_and_set(std::memory_order_acquire)) {
    }
    header.block->next = lists[header.exponent];
    lists[header.exponent] = header.block;
    taken.clear(std::memory_order_release);
}

void* calloc(std::size_t count, std::size_t each) {
    std::size_t size = 0;
    if (__builtin_mul_overflow(count, each, &size)) {
        errno = ENOMEM;
        return nullptr;
    }
    void* const data = malloc(size);
    return data == nullptr ? nullptr : std::memset(data, 0, size);
}

void* realloc(void* data, std::size_t size) {
    if (data == nullptr) return malloc(size);
    if (size <= room_of(data)) return data;
    void* const larger = malloc(size);
    if (larger == nullptr) return nullptr;
    std::memcpy(larger, data, room_of(data));
    free(data);
    return larger;
}

void* aligned_alloc(std::size_t alignment, std::size_t size) { return allocate(size, alignment); }

void* memalign(std::size_t alignment, std::size_t size) { return allocate(size, alignment); }

int posix_memalign(void** data, std::size_t alignment, std::size_t size) {
    void* const found = allocate(size, alignment);
    if (found == nullptr) return ENOMEM;
    *data = found;
    return 0;
}

std::size_t malloc_usable_size(void* data) { return data == nullptr ? 0 : room_of(data); }

}  // extern "C"
