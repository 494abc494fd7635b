#include "curvewise/attempt.hpp"

#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>

#include "curvewise/control.hpp"

namespace curvewise {
namespace {

Failure failure(Status status, const char* message) noexcept {
    Failure result;
    result.status = status;
    std::snprintf(result.message, sizeof result.message, "%s", message);
    return result;
}

}  // namespace

Failure failure_of_exception() noexcept {
    try {
        throw;
    } catch (const std::invalid_argument& refused) {
        return failure(Status::invalid_argument, refused.what());
    } catch (const std::bad_alloc& exhausted) {
        return failure(Status::no_memory, exhausted.what());
    } catch (const Stopped& stopped) {
        return failure(Status::stopped, stopped.what());
    } catch (const std::exception& other) {
        return failure(Status::failed, other.what());
    } catch (...) {  // the library throws no others; a caller's function may
        return failure(Status::failed, "an exception of unknown type");
    }
}

}  // namespace curvewise
