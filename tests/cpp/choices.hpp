// The source of a test's choices: a random generator (Random of curves.hpp, RandomChoices), or the
// bytes of a fuzzer (tests/fuzz). The same code builds curves and options from either.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>

namespace test {

class Choices {
   public:
    Choices() = default;
    Choices(const Choices&) = delete;
    Choices(Choices&&) = delete;
    Choices& operator=(const Choices&) = delete;
    Choices& operator=(Choices&&) = delete;
    virtual ~Choices() = default;

    // The next `count` bytes, at most 8, the lowest first.
    virtual std::uint64_t bytes(int count) = 0;

    // 0, ..., count - 1.
    virtual std::ptrdiff_t index(std::ptrdiff_t count) {
        const std::uint64_t drawn = bytes(count <= 256 ? 1 : 4);
        return static_cast<std::ptrdiff_t>(drawn % static_cast<std::uint64_t>(count));
    }
    std::ptrdiff_t between(std::ptrdiff_t least, std::ptrdiff_t most) {
        return least + index(most - least + 1);
    }
    bool one_in(std::ptrdiff_t count) { return index(count) == count - 1; }
    // From low to high, in steps of a 2^32nd.
    virtual double uniform(double low, double high) {
        return low + (high - low) * std::ldexp(static_cast<double>(bytes(4)), -32);
    }
    // Any double at all: nan and infinity too.
    double any_double() {
        const std::uint64_t drawn = bytes(8);
        double value = 0.0;
        std::memcpy(&value, &drawn, sizeof value);
        return value;
    }
};

// The same for the same seed and number, whatever was drawn before.
class RandomChoices final : public Choices {
   public:
    RandomChoices(std::uint64_t seed, std::uint64_t number) {
        std::seed_seq sequence{seed, seed >> 32, number, number >> 32};
        engine_.seed(sequence);
    }
    std::uint64_t bytes(int count) override {
        const std::uint64_t drawn = engine_();
        return count == 8 ? drawn : drawn >> (64 - 8 * count);
    }

   private:
    std::mt19937_64 engine_;
};

// Zeros where the bytes end.
class ByteChoices final : public Choices {
   public:
    ByteChoices(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
    std::uint64_t bytes(int count) override {
        std::uint64_t drawn = 0;
        for (int k = 0; k < count && left_ > 0; ++k, --left_) {
            drawn |= static_cast<std::uint64_t>(*data_++) << (8 * k);
        }
        return drawn;
    }

   private:
    const std::uint8_t* data_;
    std::size_t left_;
};

}  // namespace test
