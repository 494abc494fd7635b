// Every error of a call becomes a status and a message, and every value is kept.
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "check.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using namespace curvewise;

using Points = std::vector<std::array<double, 2>>;

const Points line{{0.0, 0.0}, {1.0, 0.0}};
const Points other{{0.0, 1.0}, {1.0, 3.0}};

template <class Value>
void check_failed(const Attempt<Value>& tried, Status status, const std::string& message) {
    CHECK(!tried);
    CHECK(tried.status() == status);
    CHECK_EQUAL(std::string(tried.message()), message);
}

void a_value_is_kept() {
    const auto distance = attempt([] { return frechet(line, other); });
    CHECK(static_cast<bool>(distance));
    CHECK(distance.status() == Status::ok);
    CHECK_EQUAL(*distance, 3.0);
    CHECK_EQUAL(std::string(distance.message()), std::string());
    const auto alignment = attempt([] { return dtw_path(line, other); });
    CHECK_EQUAL(alignment->distance, dtw(line, other));
}

void a_value_is_moved_out() {
    auto owner = attempt([] { return std::make_unique<int>(7); });
    const std::unique_ptr<int> taken = *std::move(owner);
    CHECK_EQUAL(*taken, 7);
}

void a_call_without_a_result_has_a_status() {
    Points out(2);
    CHECK(static_cast<bool>(attempt([&] { out[0] = line[1]; })));
    CHECK_EQUAL(out[0][0], 1.0);
    check_failed(attempt([] { throw std::runtime_error("no level v9"); }), Status::failed,
                 "no level v9");
}

void errors_of_the_library_have_a_status() {
    const Points broken{{0.0, 0.0}, {1.0, std::nan("")}};
    check_failed(attempt([&] { return dtw(line, broken); }), Status::invalid_argument,
                 "Q[1, 1] is nan; curves must be finite");
    Control control;
    control.stop();
    const Points many(3000, {0.0, 1.0});
    check_failed(attempt([&] { return dtw(many, many, {}, &control); }), Status::stopped,
                 Stopped().what());
}

void errors_of_any_function_have_a_status() {
    check_failed(attempt([]() -> int { throw std::bad_alloc(); }), Status::no_memory,
                 std::bad_alloc().what());
    check_failed(attempt([]() -> int { throw 3; }), Status::failed, "an exception of unknown type");
}

void a_long_message_is_cut() {
    const auto refused = attempt([] { throw std::invalid_argument(std::string(1000, 'x')); });
    CHECK_EQUAL(std::string(refused.message()), std::string(255, 'x'));
}

}  // namespace

int main() {
    return check::run(
        {{"a value is kept", a_value_is_kept},
         {"a value is moved out", a_value_is_moved_out},
         {"a call without a result has a status", a_call_without_a_result_has_a_status},
         {"errors of the library have a status", errors_of_the_library_have_a_status},
         {"errors of any function have a status", errors_of_any_function_have_a_status},
         {"a long message is cut", a_long_message_is_cut}});
}
