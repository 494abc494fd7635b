// Means, gradients, compare, and calls that are stopped: against the textbook
// (tests/stress/check_more.hpp).
#include "check_more.hpp"
#include "fuzz_target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::run(data, size, [](test::Choices& choices, stress::Record& record) {
        stress::check_more(choices, record);
    });
}
