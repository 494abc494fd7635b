// Partial curve mapping against section 2.1 of Jekel et al. (2018) followed step by step, with a
// new search for every point (textbook_planar.hpp); values by hand; roles, matches and messages.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "../../stress/textbook_planar.hpp"
#include "check.hpp"
#include "curves.hpp"
#include "curvewise/pcm.hpp"

namespace {

using curvewise::pcm;
using curvewise::pcm_match;
using curvewise::PcmMatch;
using curvewise::PcmOptions;
using test::Curve;
using test::Random;

constexpr PcmOptions continuous{200, true};

void values_by_hand() {
    // P's box is 2 by 4, so Q is one unit above P after scaling.
    const Curve P{{0.0, 0.0}, {2.0, 4.0}}, Q{{0.0, 4.0}, {2.0, 8.0}};
    CHECK_CLOSE(pcm(P, Q), std::sqrt(2.0), 1e-15);
    CHECK_EQUAL(pcm(P, P), 0.0);
    // y is not scaled if P's extent in it is zero.
    const Curve flat{{1.0, 5.0}, {3.0, 5.0}};
    CHECK_EQUAL(pcm(flat, Curve{{1.0, 8.0}, {3.0, 8.0}}), 3.0);
    // P has length 1 and Q length 4, two above: the distance is hypot(2, offset).
    const Curve longer{{1.0, 7.0}, {9.0, 7.0}};
    CHECK_EQUAL(pcm(flat, longer), 2.0);
    CHECK_EQUAL(pcm(flat, longer, {1, false}), 2.0);
    // Its beginning cut off: the best offset is not the first.
    const Curve earlier{{-5.0, 7.0}, {11.0, 7.0}};
    CHECK_CLOSE(pcm(flat, earlier, {1, false}), std::hypot(2.0, 3.0), 1e-15);
    CHECK_CLOSE(pcm(flat, earlier, {8, false}), 2.0, 1e-15);
    CHECK_CLOSE(pcm(flat, earlier, {3, false}), std::hypot(2.0, 0.5), 1e-15);
    CHECK_CLOSE(pcm(flat, earlier, continuous), 2.0, 1e-12);
}

void random_curves() {
    Random random(61);
    for (int repeat = 0; repeat < 100; ++repeat) {
        const Curve P = random.walk(3 + random.index(30)), Q = random.walk(3 + random.index(30));
        const check::Note note(test::described(P, Q) + ", repeat " + std::to_string(repeat));
        for (const std::ptrdiff_t offsets : {1, 2, 7, 200}) {
            const textbook::Long expected = textbook::pcm(P, Q, offsets, 0).value;
            CHECK_CLOSE(pcm(P, Q, {offsets, false}), static_cast<double>(expected), 1e-12);
        }
        CHECK(pcm(P, Q, continuous) <= pcm(P, Q));
    }
}

double length_by_box_of(const Curve& P, const Curve& curve) {
    return static_cast<double>(textbook::measured_by_box_of(P, curve).lengths.back());
}

// A curve against a run of its vertices, either way round.
void a_piece_of_the_other() {
    Random random(62);
    for (int repeat = 0; repeat < 40; ++repeat) {
        const Curve whole = random.walk(60);
        const std::ptrdiff_t first = random.index(45), last = first + 5 + random.index(10);
        const Curve piece = whole.part(first, last);
        const check::Note note("points " + std::to_string(first) + " to " + std::to_string(last));
        for (const bool piece_first : {true, false}) {
            const Curve& P = piece_first ? piece : whole;
            const Curve& Q = piece_first ? whole : piece;
            const double S = length_by_box_of(P, piece), T = length_by_box_of(P, whole);
            CHECK(pcm(P, Q) <= S * (T - S) / 398.0);
            CHECK(pcm(P, Q, continuous) <= 1e-12 * S + 1e-14 * T);
            const PcmMatch match = pcm_match(P, Q, continuous);
            CHECK_EQUAL(match.maps_p, piece_first);
            CHECK_CLOSE(match.coverage, S / T, 1e-12);
            CHECK_EQUAL(match.points.size(), static_cast<std::size_t>(piece.size()));
            for (std::size_t i = 0; i < match.points.size(); ++i) {
                const auto row = static_cast<std::ptrdiff_t>(i);
                CHECK(std::abs(match.points[i][0] - piece(row, 0)) < 1e-9);
                CHECK(std::abs(match.points[i][1] - piece(row, 1)) < 1e-9);
            }
        }
    }
}

// A match's offset and points give its value again.
void matches() {
    Random random(63);
    for (const PcmOptions& options : {PcmOptions{}, PcmOptions{5, false}, continuous}) {
        const Curve P = random.walk(30), Q = random.walk(17);
        const PcmMatch match = pcm_match(P, Q, options);
        CHECK_EQUAL(match.value, pcm(P, Q, options));
        const Curve& mapped = match.maps_p ? P : Q;
        const Curve& other = match.maps_p ? Q : P;
        const double S = length_by_box_of(P, mapped), T = length_by_box_of(P, other);
        CHECK(S <= T);
        CHECK_CLOSE(match.coverage, S / T, 1e-14);
        CHECK(match.offset >= 0.0 && match.offset <= T - S);
        const textbook::Long area = textbook::pcm(P, Q, 1, match.offset).area_at_best;
        CHECK_CLOSE(match.value, static_cast<double>(area), 1e-12);
        const textbook::Measured s = textbook::measured_by_box_of(P, mapped);
        const textbook::Measured t = textbook::measured_by_box_of(P, other);
        CHECK_EQUAL(match.points.size(), s.lengths.size());
        for (std::size_t i = 0; i < match.points.size(); ++i) {
            const auto [k, h] = t.place(s.lengths[i] + match.offset);
            const auto row = static_cast<std::ptrdiff_t>(k);
            for (std::ptrdiff_t c : {0, 1}) {
                const auto expected = other(row, c) + h * (other(row + 1, c) - other(row, c));
                CHECK(std::abs(match.points[i][static_cast<std::size_t>(c)] - expected) < 1e-10);
            }
        }
    }
}

// P counts as the shorter curve where the lengths are equal to rounding.
void equal_lengths() {
    const Curve P{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}, Q{{0.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}};
    CHECK(pcm_match(P, Q).maps_p);
    const Curve longer{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0 + 1e-13}, {1.0, 1.0}};
    CHECK(pcm_match(longer, Q).maps_p);
    const Curve much_longer{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0 + 1e-9}, {1.0, 1.0}};
    CHECK(!pcm_match(much_longer, Q).maps_p);
    CHECK(pcm_match(Q, much_longer).maps_p);
}

// The value does not depend on the unit.
void magnitudes() {
    Random random(64);
    const Curve P = random.walk(20), Q = random.walk(30);
    const PcmMatch match = pcm_match(P, Q);
    for (const std::vector<int>& k : test::powers_for_x_and_y()) {
        const check::Note note("x times 2^" + std::to_string(k[0]) + ", y times 2^" +
                               std::to_string(k[1]));
        const PcmMatch scaled = pcm_match(P.times_powers_of_two(k), Q.times_powers_of_two(k));
        CHECK_EQUAL(scaled.value, match.value);
        CHECK_EQUAL(scaled.offset, match.offset);
        CHECK_EQUAL(scaled.coverage, match.coverage);
        CHECK_EQUAL(scaled.points[3][0], std::ldexp(match.points[3][0], k[0]));
        CHECK_EQUAL(scaled.points[3][1], std::ldexp(match.points[3][1], k[1]));
    }
    // If P's extent is zero, the unit stays: the same 3 above, for x of the order of 1 and of
    // 2^600.
    for (const int k : {400, 600}) {
        const check::Note note("x times 2^" + std::to_string(k));
        const double end = std::ldexp(1.0, k);
        CHECK_EQUAL(pcm(Curve{{0.0, 0.0}, {end, 0.0}}, Curve{{0.0, 3.0}, {end, 3.0}}), 3.0);
    }
}

// A curve longer than the largest double, in units of P's box.
void beyond_the_range() {
    const Curve P{{0.0, 0.0}, {1e-200, 1e-200}}, Q{{0.0, 0.0}, {1e200, 0.0}, {0.0, 1e200}};
    for (const PcmOptions& options : {PcmOptions{}, continuous}) {
        const PcmMatch match = pcm_match(P, Q, options);
        CHECK_EQUAL(match.value, std::numeric_limits<double>::infinity());
        CHECK_EQUAL(pcm(P, Q, options), match.value);
        CHECK_EQUAL(match.offset, 0.0);
        CHECK_EQUAL(match.coverage, 0.0);
        CHECK_EQUAL(match.tolerance, match.value);
        CHECK_EQUAL(match.points.size(), std::size_t{2});
        CHECK(std::isnan(match.points[1][0]) && std::isnan(match.points[1][1]));
    }
    // A segment longer than the largest double; Q is its first half.
    const Curve wide{{-1.5e308, 0.0}, {1.5e308, 1.0}}, half{{-1.5e308, 0.0}, {0.0, 0.5}};
    const PcmMatch match = pcm_match(wide, half);
    CHECK_EQUAL(match.value, 0.0);
    CHECK_EQUAL(match.points, (std::vector<std::array<double, 2>>{{-1.5e308, 0.0}, {0.0, 0.5}}));
    // Long, but not too long, though its square would be.
    CHECK_CLOSE(pcm_match(P, Curve{{0.0, 0.0}, {1e-20, 0.0}}).coverage, std::sqrt(2.0) * 1e-180,
                1e-14);
}

void messages() {
    const Curve P{{0.0, 0.0}, {1.0, 1.0}}, point{{0.0, 0.0}}, still{{2.0, 3.0}, {2.0, 3.0}};
    const auto refuses = [](const Curve& A, const Curve& B, const PcmOptions& options,
                            const std::string& message) {
        CHECK_THROWS(pcm(A, B, options), std::invalid_argument, message);
        CHECK_THROWS(pcm_match(A, B, options), std::invalid_argument, message);
    };
    refuses(P, P, {0, false}, "offsets is 0; give a whole number >= 1, or 'continuous'");
    refuses(point, P, {-7, false}, "offsets is -7; give a whole number >= 1, or 'continuous'");
    refuses(point, P, {}, "P has shape (1, 2); pcm needs at least 2 points");
    refuses(P, Curve({}, 2), {}, "Q has shape (0, 2); pcm needs at least 2 points");
    refuses(still, P, {},
            "P has zero length (all its points are equal); pcm needs two different points");
    refuses(P, still, continuous,
            "Q has zero length (all its points are equal); pcm needs two different points");
    refuses(Curve{{0.0}, {1.0}}, Curve{{0.0}, {1.0}}, {},
            "P has shape (2, 1) and Q has shape (2, 1); pcm needs 2 coordinates, x and y");
    refuses(P, Curve{{0.0, 1.0}, {std::nan(""), 1.0}}, {}, "Q[1, 0] is nan; curves must be finite");
    CHECK_EQUAL(pcm(P, P, {0, true}), 0.0);  // not used
}

}  // namespace

int main() {
    return check::run({{"values by hand", values_by_hand},
                       {"random curves", random_curves},
                       {"a piece of the other", a_piece_of_the_other},
                       {"matches", matches},
                       {"equal lengths", equal_lengths},
                       {"magnitudes", magnitudes},
                       {"beyond the range", beyond_the_range},
                       {"messages", messages}});
}
