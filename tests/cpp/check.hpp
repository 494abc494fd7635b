// Checks for the tests. A test is a plain executable. A check that fails prints its place, its text
// and the values; the test continues, and the executable returns 1 at the end. The macros exist
// only for the place and the text.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#define CHECK(condition) ::check::is_true({__FILE__, __LINE__, #condition}, (condition))
#define CHECK_EQUAL(actual, expected) \
    ::check::is_equal({__FILE__, __LINE__, #actual " == " #expected}, actual, expected)
// |actual - expected| <= relative * the larger magnitude.
#define CHECK_CLOSE(actual, expected, relative) \
    ::check::is_close({__FILE__, __LINE__, #actual " ~ " #expected}, actual, expected, relative)
// The message is compared whole.
#define CHECK_THROWS(expression, Exception, message) \
    ::check::throws<Exception>(                      \
        {__FILE__, __LINE__, #expression}, [&] { static_cast<void>(expression); }, message)

namespace check {

struct Place {
    const char* file;
    int line;
    const char* text;
};

inline int failures = 0;
inline std::vector<std::string> notes;

// What the checks of a scope are about; printed with each of them that fails.
class Note {
   public:
    explicit Note(std::string text) { notes.push_back(std::move(text)); }
    ~Note() { notes.pop_back(); }
    Note(const Note&) = delete;
    Note(Note&&) = delete;
    Note& operator=(const Note&) = delete;
    Note& operator=(Note&&) = delete;
};

inline void fail(const Place& place, const std::string& what) {
    constexpr int most_printed = 20;
    if (++failures > most_printed) return;
    std::printf("%s:%d: %s\n    %s\n", place.file, place.line, place.text, what.c_str());
    for (const std::string& note : notes) std::printf("    with %s\n", note.c_str());
}

template <class T, class = void>
inline constexpr bool is_range = false;
template <class T>
inline constexpr bool is_range<T, std::void_t<decltype(std::begin(std::declval<const T&>()))>> =
    true;

template <class T>
void write(std::ostream& out, const T& value) {
    if constexpr (std::is_convertible_v<const T&, std::string>) {
        out << '"' << std::string(value) << '"';
    } else if constexpr (is_range<T>) {
        out << '[';
        for (const auto& element : value) {
            if (&element != &*std::begin(value)) out << ", ";
            write(out, element);
        }
        out << ']';
    } else {
        out << value;
    }
}

template <class Actual, class Expected>
std::string both(const Actual& actual, const Expected& expected) {
    std::ostringstream out;
    out.precision(17);
    out << std::boolalpha << "got ";
    write(out, actual);
    out << ", expected ";
    write(out, expected);
    return out.str();
}

inline void is_true(const Place& place, bool condition) {
    if (!condition) fail(place, "is false");
}

template <class Actual, class Expected>
void is_equal(const Place& place, const Actual& actual, const Expected& expected) {
    if (!(actual == expected)) fail(place, both(actual, expected));
}

inline void is_close(const Place& place, double actual, double expected, double relative) {
    if (actual == expected) return;
    const double difference = std::abs(actual - expected);
    const double allowed = relative * std::max(std::abs(actual), std::abs(expected));
    if (std::isfinite(difference) && difference <= allowed) return;
    fail(place, both(actual, expected) + ", difference " + std::to_string(difference / allowed) +
                    " times what is allowed");
}

template <class Exception, class Action>
void throws(const Place& place, Action action, const std::string& message) {
    try {
        action();
    } catch (const Exception& error) {
        if (error.what() != message) fail(place, both(error.what(), message));
        return;
    } catch (const std::exception& error) {
        fail(place, std::string("throws another exception: ") + error.what());
        return;
    }
    fail(place, "does not throw");
}

struct Test {
    const char* name;
    std::function<void()> body;
};

// For main to return.
inline int run(std::initializer_list<Test> tests) {
    for (const Test& test : tests) {
        const int failures_before = failures;
        try {
            test.body();
        } catch (const std::exception& error) {
            fail({test.name, 0, "the test ends early"}, error.what());
        }
        if (failures > failures_before) std::printf("FAILED: %s\n", test.name);
    }
    if (failures > 0) std::printf("%d checks failed\n", failures);
    return failures > 0 ? 1 : 0;
}

}  // namespace check
