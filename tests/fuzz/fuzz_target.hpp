// One target: the bytes become choices, and the choices become curves and options (tests/stress).
// The first comparison that fails ends the run, as a crash does. So does an exception, because all
// drawn inputs are valid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "choices.hpp"
#include "record.hpp"

namespace fuzz {

template <class Check>
int run(const std::uint8_t* data, std::size_t size, Check check) {
    test::ByteChoices choices(data, size);
    stress::Record record;
    try {
        check(choices, record);
    } catch (const std::exception& error) {
        std::printf("an exception: %s\n", error.what());
        std::abort();
    }
    if (record.failures() > 0) std::abort();
    return 0;
}

}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
