// A poller that reports nothing and never stops, for tests of functions that need one.
#pragma once

#include "runtime/poller.hpp"

namespace test {

inline curvewise::runtime::Poller unpolled(nullptr);

}  // namespace test
