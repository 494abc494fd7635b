/// \file
/// Calls whose errors are values, for code that must not let an exception pass: control loops,
/// callbacks of other libraries, plug-ins.
///
///     const auto distance = curvewise::attempt([&] { return curvewise::dtw(P, Q); });
///     if (distance) {
///         show(*distance);
///     } else {
///         log(distance.message());  // "Q[17, 1] is nan; curves must be finite"
///     }
#pragma once

#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "curvewise/export.h"

namespace curvewise {

/// How a call went, with the numbers of the C interface.
enum class Status {
    ok = 0,
    invalid_argument = 1,  ///< a curve or an option is refused
    no_memory = 2,
    failed = 3,   ///< anything else
    stopped = 4,  ///< by its Control
};

/// Why a call failed. The message is one line; a longer one is cut.
struct Failure {
    Status status = Status::ok;
    char message[256] = "";
};

/// Of the exception that is being handled: for a `catch (...)` of your own.
CURVEWISE_EXPORT Failure failure_of_exception() noexcept;

/// The value of a call, or why there is none.
template <class Value>
class [[nodiscard]] Attempt {
   public:
    template <class Call>
    explicit Attempt(const Call& call) noexcept {
        try {
            if constexpr (std::is_void_v<std::invoke_result_t<const Call&>>) {
                call();
                value_.emplace();
            } else {
                value_.emplace(call());
            }
        } catch (...) {
            failure_ = failure_of_exception();
        }
    }

    explicit operator bool() const noexcept { return value_.has_value(); }
    Status status() const noexcept { return failure_.status; }
    /// Lives as long as this object; empty if the call went well.
    const char* message() const noexcept { return failure_.message; }

    /// Only if the call went well.
    const Value& operator*() const& noexcept { return *value_; }
    Value&& operator*() && noexcept { return *std::move(value_); }
    const Value* operator->() const noexcept { return &*value_; }

   private:
    std::optional<Value> value_;
    Failure failure_;
};

/// Calls `call()`, and keeps its value or the error that it throws. Of a function without a result,
/// the value is a std::monostate.
template <class Call, class Result = std::decay_t<std::invoke_result_t<const Call&>>>
auto attempt(const Call& call) noexcept {
    return Attempt<std::conditional_t<std::is_void_v<Result>, std::monostate, Result>>(call);
}

}  // namespace curvewise
