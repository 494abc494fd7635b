// The counts of a stress run: comparisons of every kind, and failed ones. The first failures are
// printed with all data that is needed to reproduce them.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hard_curves.hpp"

namespace stress {

using namespace test;

struct Count {
    std::int64_t compared = 0;
    std::int64_t wrong = 0;
};

// Every coordinate, so that a failure can be typed in.
inline std::string described(const char* name, const test::Curve& curve) {
    std::string text = std::string(name) + "=[";
    for (std::ptrdiff_t i = 0; i < curve.size() && i < 40; ++i) {
        text += i == 0 ? "(" : "),(";
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            char number[40];
            std::snprintf(number, sizeof number, c == 0 ? "%.17g" : ",%.17g", curve(i, c));
            text += number;
        }
    }
    return text + (curve.size() > 40 ? ")...] " : ")] ");
}

// What a comparison is about; written out only where it fails.
struct About {
    std::string options;
    std::vector<std::pair<const char*, const test::Curve*>> curves;

    std::string text() const {
        std::string all = options;
        for (const auto& [name, curve] : curves) all += " " + described(name, *curve);
        return all;
    }
};

class Record {
   public:
    // `about` is printed with each failure: the seed and number, or nothing.
    void begin(std::string round) { round_ = std::move(round); }
    void is_true(const std::string& what, bool holds, const About& with,
                 const std::string& more = "") {
        Count& count = counts_[what];
        ++count.compared;
        if (holds) return;
        ++count.wrong;
        if (++failures_ <= most_printed) {
            std::printf("WRONG %s: %s%s [%s]\n", what.c_str(), with.text().c_str(), more.c_str(),
                        round_.c_str());
            std::fflush(stdout);
        }
    }
    // To the last bit; no value is a nan.
    void same(const std::string& what, double actual, double expected, const About& with) {
        if (std::memcmp(&actual, &expected, sizeof actual) == 0 && !std::isnan(actual)) {
            ++counts_[what].compared;
            return;
        }
        is_true(what, false, with, both(actual, expected));
    }
    // |actual - expected| <= tolerance * scale, or both infinite.
    void close(const std::string& what, double actual, double expected, double allowed,
               const About& with) {
        const bool holds = actual == expected || std::abs(actual - expected) <= allowed;
        is_true(what, holds, with, holds ? "" : both(actual, expected));
    }
    void skip(const char* what) { ++skipped_[what]; }

    std::int64_t failures() const noexcept { return failures_; }
    const std::map<std::string, Count>& counts() const noexcept { return counts_; }
    std::map<std::string, Count>& counts() noexcept { return counts_; }
    const std::map<std::string, std::int64_t>& skipped() const noexcept { return skipped_; }
    std::map<std::string, std::int64_t>& skipped() noexcept { return skipped_; }

    static std::string both(double actual, double expected) {
        char text[120];
        std::snprintf(text, sizeof text, ": got %.17g (%a), expected %.17g (%a)", actual, actual,
                      expected, expected);
        return text;
    }

   private:
    static constexpr std::int64_t most_printed = 40;
    std::string round_;
    std::map<std::string, Count> counts_;
    std::map<std::string, std::int64_t> skipped_;
    std::int64_t failures_ = 0;
};

}  // namespace stress
