// The file of an index: it answers with the same bits, and a damaged one is refused or answers with
// them, too.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;
using test::shape_of;

using Indices = std::vector<std::int64_t>;

// A folder for the files of a test, with letters beyond ASCII in its name.
class Folder {
   public:
    Folder()
        : path_(std::filesystem::temp_directory_path() /
                std::filesystem::u8path("cürvewise-" + std::to_string(std::random_device()()))) {
        std::filesystem::create_directories(path_);
    }
    Folder(const Folder&) = delete;
    Folder(Folder&&) = delete;
    Folder& operator=(const Folder&) = delete;
    Folder& operator=(Folder&&) = delete;
    ~Folder() { std::filesystem::remove_all(path_); }

    std::string file(const char* name) const { return (path_ / name).u8string(); }
    std::ptrdiff_t files() const {
        return std::distance(std::filesystem::directory_iterator(path_), {});
    }

   private:
    std::filesystem::path path_;
};

std::string contents(const std::string& path) {
    std::ifstream file(std::filesystem::u8path(path), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::string& path, const std::string& bytes) {
    std::ofstream(std::filesystem::u8path(path), std::ios::binary) << bytes;
}

bool are_equal(const std::vector<Neighbor>& a, const std::vector<Neighbor>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Neighbor& x, const Neighbor& y) {
                          return x.index == y.index && x.distance == y.distance;
                      });
}

// All answers to X, and to the curves themselves.
std::vector<std::vector<Neighbor>> answers(const Index& index, const std::vector<CurveView>& X) {
    const auto size = static_cast<std::ptrdiff_t>(index.size());
    std::vector<double> distances(X.size() * index.size());
    Indices indices(distances.size());
    index.kneighbors(X, size, distances.data(), indices.data());
    std::vector<std::vector<Neighbor>> all(1);
    for (std::size_t k = 0; k < indices.size(); ++k) all[0].push_back({indices[k], distances[k]});
    all.push_back(index.kneighbors(size - 1));
    for (const auto& near : index.radius_neighbors(X, distances[distances.size() / 2])) {
        all.push_back(near);
    }
    return all;
}

void check_equal(const Index& index, const Index& expected, const std::vector<CurveView>& X) {
    CHECK_EQUAL(index.indices(), expected.indices());
    CHECK_EQUAL(index.next_index(), expected.next_index());
    const auto ours = answers(index, X), theirs = answers(expected, X);
    CHECK_EQUAL(ours.size(), theirs.size());
    for (std::size_t k = 0; k < ours.size(); ++k) CHECK(are_equal(ours[k], theirs[k]));
    for (std::size_t j = 0; j < index.size(); ++j) {
        const CurveView a = index.curves()[j], b = expected.curves()[j];
        CHECK_EQUAL(shape_of(a), shape_of(b));
        for (std::ptrdiff_t i = 0; i < a.size(); ++i) {
            for (std::ptrdiff_t c = 0; c < a.dim(); ++c) CHECK_EQUAL(a(i, c), b(i, c));
        }
    }
}

std::vector<Measure> measures() {
    DtwOptions on_sphere;
    on_sphere.ground.metric = Metric::haversine;
    std::vector<Measure> all{on_sphere};
    for_each_measure([&](const auto& defaults) { all.push_back(defaults); });
    for (Measure& measure : all) {
        if (auto* options = std::get_if<CurveLengthOptions>(&measure)) {
            options->scale = LengthScale::range;
        }
    }
    return all;
}

std::vector<Curve> random_curves(int count) {
    Random random(31);
    std::vector<Curve> curves;
    for (int i = 0; i < count; ++i) curves.push_back(random.walk(2 + random.index(20)));
    for (Curve& curve : curves) curve(0, 0) -= 1.0;  // a walk of two points may have no length
    return curves;
}

void an_opened_index_has_the_same_answers() {
    const Folder folder;
    const std::string path = folder.file("index");
    const std::vector<Curve> owners = random_curves(20);
    const std::vector<CurveView> all = test::views_of(owners);
    const std::vector<CurveView> X(all.begin() + 16, all.end());
    for (const Measure& measure : measures()) {
        const check::Note note("measure " + std::to_string(measure.index()));
        Index index({all.begin(), all.begin() + 10}, measure);
        index.remove({0, 4, 9});
        index.add({all.begin() + 10, all.begin() + 12});
        index.save(path, std::string("no\0te", 5));
        const IndexFile file(path);
        CHECK_EQUAL(file.note(), std::string("no\0te", 5));
        Index opened = Index::open(file, measure);
        check_equal(opened, index, X);
        for (Index* const one : {&index, &opened}) {
            one->remove({11, 1});
            one->add({all.begin() + 12, all.begin() + 16});
            one->remove({12});
        }
        check_equal(opened, index, X);
        opened.save(path);  // over its own points
        check_equal(opened, index, X);
        check_equal(Index::open(path, measure), index, X);
        CHECK_EQUAL(IndexFile(path).note(), std::string());
        for (const Measure& other : measures()) {
            if (std::holds_alternative<LcssOptions>(other)) continue;  // its distances are equal
            check_equal(Index::open(path, other),
                        Index(index.curves(), index.indices(), index.next_index(), other), X);
        }
    }
    CHECK_EQUAL(folder.files(), std::ptrdiff_t{1});
}

void an_index_without_curves() {
    const Folder folder;
    const std::string path = folder.file("index");
    Index index({}, DtwOptions{});
    index.save(path);
    CHECK_EQUAL(Index::open(path, DtwOptions{}).size(), std::size_t{0});
    const Curve P{{1.0}};
    index.add({P, P});
    index.remove({0, 1});
    index.save(path);
    Index opened = Index::open(path, AreaOptions{});
    CHECK_EQUAL(opened.next_index(), std::int64_t{2});
    const Curve Q{{0, 0}, {1, 1}};
    opened.add({Q});
    CHECK_EQUAL(opened.indices(), Indices{2});
    const double flat[] = {0.0, 1.0, 3.0};
    Index({CurveView(flat)}, DtwOptions{}).save(path);
    CHECK_EQUAL(shape_of(Index::open(path, DtwOptions{}).curves()[0]), std::string("(3,)"));
    CHECK_THROWS(Index::open(path, AreaOptions{}), std::invalid_argument,
                 "curves[0] has shape (3,); area needs 2 coordinates, x and y");
}

// Every byte in two other states, every length, and more bytes.
void a_damaged_file_is_refused_or_answers_as_before() {
    const Folder folder;
    const std::string path = folder.file("index");
    const Curve P{{0, 0}, {1, 1}}, Q{{0, 1}, {1, 2}, {2, 5}};
    const std::vector<CurveView> X{P};
    Index index({P, Q, P}, FrechetOptions{});
    index.remove({0});
    index.save(path, "note");
    const std::string whole = contents(path);
    const auto expected = answers(index, X);
    int refused = 0, answered = 0;
    const auto check = [&](const std::string& bytes) {
        write(path, bytes);
        try {
            const Index opened = Index::open(path, FrechetOptions{});
            const auto found = answers(opened, X);
            CHECK_EQUAL(found.size(), expected.size());
            for (std::size_t k = 0; k < found.size(); ++k) {
                CHECK(are_equal(found[k], expected[k]));
            }
            ++answered;
        } catch (const std::runtime_error& error) {
            CHECK(std::string(error.what()).find(path) == 0);
            ++refused;
        }
    };
    check(whole);
    CHECK_EQUAL(answered, 1);
    for (std::size_t k = 0; k < whole.size(); ++k) {
        for (const int mask : {0x01, 0x80, 0xFF}) {
            std::string bytes = whole;
            bytes[k] = static_cast<char>(bytes[k] ^ mask);
            check(bytes);
        }
        check(whole.substr(0, k));
        if (k % 8 == 0 && k > 0) check(whole + whole.substr(0, k));
    }
    CHECK_EQUAL(answered, 1);
    CHECK(refused > 1000);
}

void refusals_say_why() {
    const Folder folder;
    const std::string path = folder.file("index"), none = folder.file("none");
    const Curve P{{0, 0}, {1, 1}};
    const Index index({P}, DtwOptions{});
    index.save(path);
    const std::string whole = contents(path);
    const auto refuses = [&](const std::string& bytes, const std::string& why) {
        write(path, bytes);
        CHECK_THROWS(IndexFile(path), std::runtime_error, path + " " + why);
    };
    refuses("", "is not an index of curvewise");
    refuses("shape,value\n1,2\n", "is not an index of curvewise");
    refuses(whole.substr(0, 50), "is cut off; save the index again");
    refuses(whole.substr(0, whole.size() - 8), "is cut off; save the index again");
    std::string other = whole;
    other[16] = 2;
    refuses(other,
            "has format 2, and this version of curvewise reads format 1; save the index with this "
            "version");
    other = whole;
    std::reverse(other.begin() + 8, other.begin() + 16);
    refuses(other, "was written on a computer of the other byte order; save the index on this one");
    other = whole;
    other[140] ^= 1;
    refuses(other, "is damaged; save the index again");
    other = whole;
    other[other.size() - 80] ^= 1;
    write(path, other);
    CHECK_THROWS(Index::open(path, DtwOptions{}), std::runtime_error,
                 path + " is damaged; save the index again");
    const auto fails = [&](auto call, std::errc code) {
        try {
            call();
            CHECK(false);
        } catch (const std::system_error& error) {
            CHECK(error.code() == code);
        }
    };
    fails([&] { IndexFile{none}; }, std::errc::no_such_file_or_directory);
    fails([&] { index.save(folder.file("no/such/folder")); }, std::errc::no_such_file_or_directory);
}

void a_stopped_save_leaves_the_old_file() {
    const Folder folder;
    const std::string path = folder.file("index");
    const Curve P = Random(3).curve(1000, 2);
    Index index({P}, DtwOptions{});
    index.save(path);
    const std::string old = contents(path);
    index.add(std::vector<CurveView>(50, P));
    Control stopped;
    stopped.stop();
    CHECK_THROWS(index.save(path, "", &stopped), Stopped, "stopped before the work was done");
    CHECK_EQUAL(contents(path) == old, true);
    CHECK_EQUAL(folder.files(), std::ptrdiff_t{1});
    Control stopped_again;
    stopped_again.stop();
    CHECK_THROWS(Index::open(path, DtwOptions{}, &stopped_again), Stopped,
                 "stopped before the work was done");
}

}  // namespace

int main() {
    return check::run(
        {{"an opened index has the same answers", an_opened_index_has_the_same_answers},
         {"an index without curves", an_index_without_curves},
         {"a damaged file is refused or answers as before",
          a_damaged_file_is_refused_or_answers_as_before},
         {"refusals say why", refusals_say_why},
         {"a stopped save leaves the old file", a_stopped_save_leaves_the_old_file}});
}
