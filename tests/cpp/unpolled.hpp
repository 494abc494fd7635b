// For tests of what is called with a poller: one that nobody hears of, and nobody stops.
#pragma once

#include "runtime/poller.hpp"

namespace test {

inline curvewise::runtime::Poller unpolled(nullptr);

}  // namespace test
