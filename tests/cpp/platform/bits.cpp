// Prints one hash of all result bits of a measure for many random pairs, with a line for every
// measure and option. All machines, compilers and instruction sets should print the same.
// .ci/platforms compares the output here with the output elsewhere. The pairs are made without the
// mathematical library, so that they are the same everywhere. Lines that begin with "libm" use its
// pow() and log(), which differ between systems in the last bit; these values are not guaranteed.
//
//   bits [pairs]     1000 pairs a line by default; CURVEWISE_ISA forces an instruction-set level
//   bits levels      the levels that this machine has
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "curves.hpp"
#include "curvewise/curvewise.hpp"
#include "warping/oracle.hpp"

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;

// Fowler, Noll and Vo's hash FNV-1a, of 64 bits.
class Hash {
   public:
    void add(double value) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        for (int byte = 0; byte < 8; ++byte) {
            hash_ = (hash_ ^ (bits >> (8 * byte) & 0xff)) * 0x100000001b3U;
        }
    }
    unsigned long long value() const { return hash_; }

   private:
    std::uint64_t hash_ = 0xcbf29ce484222325U;
};

struct Pair {
    Curve P, Q;
};

// Steps without sines: of uniform coordinates, some of them nought.
Curve walk(Random& random, std::ptrdiff_t n, std::ptrdiff_t dim) {
    Curve curve = random.curve(n, dim);
    for (std::ptrdiff_t i = 1; i < n; ++i) {
        const bool is_repeated = random.index(9) == 0;
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            curve(i, c) = curve(i - 1, c) + (is_repeated ? 0.0 : curve(i, c));
        }
    }
    return curve;
}

// Walks, lattice curves with their ties, similar curves, and curves beyond the usual range; some of
// them long enough for pruning.
Pair random_pair(Random& random, std::ptrdiff_t dim) {
    const std::ptrdiff_t most = random.index(40) == 0 ? 1000 : 60;
    const std::ptrdiff_t n = 2 + random.index(most), m = 2 + random.index(most);
    switch (random.index(5)) {
        case 0:
            return {random.lattice_curve(n, dim), random.lattice_curve(m, dim)};
        case 1: {
            const Curve P = walk(random, n + m, dim);
            Curve Q = P.part(0, n + 1);
            for (std::ptrdiff_t i = 0; i < Q.size(); ++i) Q(i, 0) += random.uniform(-0.01, 0.01);
            return {P, Q};
        }
        case 2: {
            const int exponent = static_cast<int>(random.index(2000)) - 1000;
            return {walk(random, n, dim).times_power_of_two(exponent),
                    walk(random, m, dim).times_power_of_two(exponent)};
        }
        default:
            return {walk(random, n, dim), walk(random, m, dim)};
    }
}

using Value = std::function<void(const Pair& pair, Hash& hash)>;

long pairs = 1000;

void print(const std::string& name, std::ptrdiff_t dim, const Value& value) {
    Random random(2024);
    Hash hash;
    for (long k = 0; k < pairs; ++k) {
        const Pair pair = random_pair(random, dim);
        try {
            value(pair, hash);
        } catch (const std::invalid_argument&) {
            hash.add(-1.0);  // lattice curves of no length, say: an answer, too
        }
    }
    std::printf("%-44s %016llx\n", name.c_str(), hash.value());
    std::fflush(stdout);
}

void add(const Alignment& alignment, Hash& hash) {
    hash.add(alignment.distance);
    for (const auto& [i, j] : alignment.path) hash.add(static_cast<double>(i << 20 | j));
}

void warping_of(const GroundDistance& ground, const std::string& name) {
    for (const std::ptrdiff_t dim : {1, 2, 3, 7}) {
        const std::string of = ", " + name + ", d = " + std::to_string(dim);
        print((name == "minkowski" ? "libm dtw" : "dtw") + of, dim, [&](const Pair& c, Hash& hash) {
            DtwOptions options;
            options.ground = ground;
            for (const bool prune : {true, false}) {
                options.prune = prune;
                for (const bool opened : {true, false}) {
                    options.open_begin = options.open_end = opened;
                    add(dtw_path(c.P, c.Q, options), hash);
                    hash.add(dtw(c.P, c.Q, options));
                }
            }
            options.step_pattern = StepPattern::symmetric2;
            options.normalize = true;
            hash.add(dtw(c.P, c.Q, options));
            options.window_fraction = 0.5;
            hash.add(dtw(c.P, c.Q, options));
        });
        print((name == "minkowski" ? "libm frechet" : "frechet") + of, dim,
              [&](const Pair& c, Hash& hash) {
                  FrechetOptions options;
                  options.ground = ground;
                  add(frechet_path(c.P, c.Q, options), hash);
                  hash.add(frechet(c.P, c.Q, options));
                  options.prune = false;
                  hash.add(frechet(c.P, c.Q, options));
              });
    }
}

void planar() {
    for (const Spacing spacing :
         {Spacing::distance, Spacing::x, Spacing::arc_length, Spacing::matched}) {
        const std::string name = choice_names(spacing)[static_cast<std::size_t>(spacing)];
        print("area, " + name, 2, [&](const Pair& c, Hash& hash) {
            for (const Crossing crossing : {Crossing::rearrange, Crossing::split}) {
                for (const double area : area_quads(c.P, c.Q, {spacing, crossing}).areas) {
                    hash.add(area);
                }
                hash.add(area(c.P, c.Q, {spacing, crossing}));
            }
        });
    }
    print("pcm", 2, [](const Pair& c, Hash& hash) {
        const PcmMatch match = pcm_match(c.P, c.Q, {20});
        for (const auto& [x, y] : match.points) hash.add(x), hash.add(y);
        hash.add(match.value);
        hash.add(match.offset);
    });
    print("pcm, continuous", 2, [](const Pair& c, Hash& hash) {
        PcmOptions options;
        options.continuous = true;
        hash.add(pcm(c.P, c.Q, options));
    });
    print("libm curve_length", 2, [](const Pair& c, Hash& hash) {
        for (const LengthScale scale : {LengthScale::mean, LengthScale::range}) {
            hash.add(curve_length(c.P, c.Q, {scale}));
        }
    });
}

void others() {
    for (const std::ptrdiff_t dim : {1, 2, 3}) {
        const std::string of = ", d = " + std::to_string(dim);
        print("frechet_continuous" + of, dim, [](const Pair& c, Hash& hash) {
            const Interval bounds = frechet_continuous_bounds(c.P, c.Q);
            hash.add(bounds.low);
            hash.add(bounds.high);
            hash.add(frechet_within(c.P, c.Q, bounds.low) ? 1.0 : 0.0);
        });
        print("dtw_mean, subsequences" + of, dim, [](const Pair& c, Hash& hash) {
            for (const Subsequence& run : subsequences(c.P.part(0, 2), c.Q, 2)) {
                hash.add(run.distance);
                hash.add(static_cast<double>(run.start));
            }
            DtwMeanOptions options;
            options.iterations = 3;
            for (const double x : dtw_mean({c.P, c.Q}, {1.0, 2.0}, c.P, options).points) {
                hash.add(x);
            }
        });
    }
    print("gradients", 2, [](const Pair& c, Hash& hash) {
        std::vector<double> gradient(c.Q.values().size());
        const auto add_all = [&](double value) {
            hash.add(value);
            for (const double slope : gradient) hash.add(slope);
        };
        add_all(value_and_gradient(DtwOptions{}, c.P, c.Q, gradient.data()));
        add_all(value_and_gradient(FrechetOptions{}, c.P, c.Q, gradient.data()));
        add_all(value_and_gradient(AreaOptions{}, c.P, c.Q, gradient.data()));
    });
    print("cdist, 3 workers", 2, [](const Pair& c, Hash& hash) {
        double out[9];
        cdist({c.P, c.Q, c.P.part(0, 2)}, DtwOptions{}, out, {3});
        for (const double value : out) hash.add(value);
    });
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && std::string(argv[1]) == "levels") {
        for (const std::string& level : build_info().instruction_sets) std::puts(level.c_str());
        return 0;
    }
    if (argc > 1) pairs = std::atol(argv[1]);
    for (const Metric metric : oracle::metrics) warping_of({metric, 3.0}, oracle::name(metric));
    planar();
    others();
    return 0;
}
