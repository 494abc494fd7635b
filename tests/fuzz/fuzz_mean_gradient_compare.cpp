// Means, gradients, compare, and calls that are stopped: against the textbook
// (tests/stress/check_mean_gradient_compare.hpp).
#include "check_mean_gradient_compare.hpp"
#include "fuzz_target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::run(data, size, [](test::Choices& choices, stress::Record& record) {
        stress::check_mean_gradient_compare(choices, record);
    });
}
