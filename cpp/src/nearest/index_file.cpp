#include "nearest/index_file.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace curvewise::nearest {
namespace {

using pairwise::PointBlocks;
using pairwise::PointLayout;
using pairwise::StoredCurve;
using runtime::Checksum;
using runtime::Poller;

static_assert(std::numeric_limits<double>::is_iec559 && sizeof(double) == 8);

// Shows a transfer as text, as in PNG.
constexpr unsigned char magic[8] = {0x89, 'c', 'w', 'i', '\r', '\n', 0x1A, '\n'};
constexpr std::uint64_t byte_order = 0x0102030405060708;
constexpr std::uint64_t other_byte_order = 0x0807060504030201;
constexpr std::uint64_t format = 1;
constexpr std::uint64_t line = 64;  // bytes; sections begin at multiples
constexpr std::uint64_t word = sizeof(std::uint64_t);
constexpr std::uint64_t words_of_curve = 3;
constexpr std::uint64_t is_flat = 1, squares_are_in_domain = 2, points = 4;  // in the second word

struct Header {
    unsigned char magic[8];
    std::uint64_t byte_order;
    std::uint64_t format;
    std::uint64_t layout;
    std::uint64_t dim;
    std::uint64_t curves;
    std::uint64_t next_index;
    std::uint64_t note_bytes;
    std::uint64_t numbers;  // of the points, without the zeros behind them
    std::uint64_t file_bytes;
    std::uint64_t checksum_of_curves;  // and of the note
    std::uint64_t checksum_of_points;  // and of what is behind
    std::uint64_t bounds_format;
    std::uint64_t bounds_numbers;
    std::uint64_t zero;
    std::uint64_t checksum;  // of all before

    std::uint64_t own_checksum() const noexcept {
        Checksum sum;
        sum.add(this, offsetof(Header, checksum) / word);
        return sum.value();
    }
};
static_assert(sizeof(Header) == 2 * line && std::is_trivially_copyable_v<Header>);

constexpr std::uint64_t rounded(std::uint64_t bytes) noexcept {
    return (bytes + line - 1) / line * line;
}

// Where the points begin. Of numbers that were checked not to be absurd.
std::uint64_t begin_of_points(const Header& header) noexcept {
    return rounded(sizeof(Header) + header.curves * words_of_curve * word + header.note_bytes);
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw std::runtime_error(path + " " + why);
}

[[noreturn]] void refuse_damaged(const std::string& path) {
    refuse(path, "is damaged; save the index again");
}

Header checked_header(const std::string& path, const std::byte* bytes, std::uint64_t size) {
    Header header{};
    if (size < sizeof magic || std::memcmp(bytes, magic, sizeof magic) != 0) {
        refuse(path, "is not an index of curvewise");
    }
    if (size < sizeof header) refuse(path, "is cut off; save the index again");
    std::memcpy(&header, bytes, sizeof header);
    if (header.byte_order == other_byte_order) {
        refuse(path,
               "was written on a computer of the other byte order; save the index on this one");
    }
    if (header.byte_order != byte_order) refuse_damaged(path);
    if (header.format != format) {
        refuse(path, "has format " + std::to_string(header.format) +
                         ", and this version of curvewise reads format " + std::to_string(format) +
                         "; save the index with this version");
    }
    if (header.checksum != header.own_checksum()) refuse_damaged(path);
    if (header.file_bytes > size) refuse(path, "is cut off; save the index again");
    const bool is_possible = header.file_bytes == size && header.curves <= size / word &&
                             header.note_bytes <= size && header.numbers <= size / word &&
                             header.bounds_numbers <= size / word && header.dim <= size &&
                             header.layout >= 1 && header.layout <= 3;
    const std::uint64_t numbers = header.numbers + PointBlocks::padding + header.bounds_numbers;
    if (!is_possible || begin_of_points(header) + numbers * word != size) refuse_damaged(path);
    return header;
}

}  // namespace

void save_index(const std::string& path, const SavedIndex& index, Poller& poller) {
    Header header{};
    std::copy(std::begin(magic), std::end(magic), header.magic);
    header.byte_order = byte_order;
    header.format = format;
    header.layout = static_cast<std::uint64_t>(index.all.layout());
    const std::ptrdiff_t dim =
        index.targets.empty() ? 0 : index.all.curve(index.targets[0]).curve.dim();
    header.dim = static_cast<std::uint64_t>(dim);
    header.curves = index.targets.size();
    header.next_index = static_cast<std::uint64_t>(index.next_index);
    header.note_bytes = index.note.size();
    header.bounds_format = index.all.bounds_format();
    std::vector<std::uint64_t> front;  // the curves and the note
    front.reserve(words_of_curve * index.targets.size());
    for (std::size_t k = 0; k < index.targets.size(); ++k) {
        const StoredCurve& curve = index.all.stored(index.targets[k]);
        const auto size = static_cast<std::uint64_t>(curve.size);
        front.push_back(static_cast<std::uint64_t>(index.indices[k]));
        front.push_back(points * size + (curve.is_flat ? is_flat : 0) +
                        (curve.squares_are_in_domain ? squares_are_in_domain : 0));
        front.push_back(0);
        std::memcpy(&front.back(), &curve.largest, sizeof curve.largest);
        header.numbers += size * header.dim;
        header.bounds_numbers += static_cast<std::uint64_t>(index.all.bounds_size(curve.size, dim));
    }
    const std::size_t note_at = front.size();
    front.resize((begin_of_points(header) - sizeof header) / word);
    if (!index.note.empty()) {
        std::memcpy(front.data() + note_at, index.note.data(), index.note.size());
    }
    header.file_bytes = begin_of_points(header) +
                        (header.numbers + PointBlocks::padding + header.bounds_numbers) * word;

    runtime::ReplacingFile file(path);
    file.write(&header, sizeof header);
    Checksum sum_of_front, sum_of_points;
    sum_of_front.add(front.data(), front.size());
    file.write(front.data(), front.size() * word);
    const auto write = [&](const double* numbers, std::ptrdiff_t count) {
        sum_of_points.add(numbers, static_cast<std::size_t>(count));
        file.write(numbers, static_cast<std::size_t>(count) * word);
    };
    for (const std::ptrdiff_t j : index.targets) {
        const StoredCurve& curve = index.all.stored(j);
        write(curve.points, curve.size * dim);
        if (poller.count_steps(curve.size)) throw Stopped();
    }
    const double zeros[PointBlocks::padding] = {};
    write(zeros, PointBlocks::padding);
    std::vector<double> bounds;
    for (const std::ptrdiff_t j : index.targets) {
        const std::ptrdiff_t count = index.all.bounds_size(index.all.stored(j).size, dim);
        if (count == 0) break;
        poller.poll_in_loop(static_cast<std::size_t>(j));
        bounds.resize(static_cast<std::size_t>(count));
        index.all.write_bounds(j, bounds.data());
        write(bounds.data(), count);
    }
    header.checksum_of_curves = sum_of_front.value();
    header.checksum_of_points = sum_of_points.value();
    header.checksum = header.own_checksum();
    file.rewind();
    file.write(&header, sizeof header);
    poller.finish();
    file.replace();
}

OpenedIndex::OpenedIndex(const std::string& name)
    : path(name), file(std::make_shared<const runtime::MappedFile>(name)) {
    const std::byte* const bytes = file->data();
    const Header header = checked_header(path, bytes, file->size());
    const std::byte* const front = bytes + sizeof header;
    const std::uint64_t begin = begin_of_points(header);
    Checksum sum;
    sum.add(front, static_cast<std::size_t>((begin - sizeof header) / word));
    if (sum.value() != header.checksum_of_curves) refuse_damaged(path);
    layout = static_cast<PointLayout>(header.layout);
    next_index = static_cast<std::int64_t>(header.next_index);
    points_ = reinterpret_cast<const double*>(bytes + begin);
    bounds_ = points_ + header.numbers + PointBlocks::padding;
    end_ = bounds_ + header.bounds_numbers;
    bounds_format_ = header.bounds_format;
    checksum_ = header.checksum_of_points;
    const auto dim = static_cast<std::ptrdiff_t>(header.dim);
    std::uint64_t place = 0;
    for (std::uint64_t k = 0; k < header.curves; ++k) {
        std::uint64_t entry[words_of_curve];
        std::memcpy(entry, front + k * sizeof entry, sizeof entry);
        const std::uint64_t size = entry[1] / points;
        // Divided, since a product may be too large.
        if (dim < 1 || size < 1 || size > (header.numbers - place) / header.dim) {
            refuse_damaged(path);
        }
        StoredCurve curve{points_ + place, 0.0, static_cast<std::ptrdiff_t>(size),
                          (entry[1] & is_flat) != 0, (entry[1] & squares_are_in_domain) != 0};
        if (curve.is_flat && dim != 1) refuse_damaged(path);
        std::memcpy(&curve.largest, &entry[2], sizeof curve.largest);
        stored.push_back(curve);
        curves.push_back(curve.view(dim, layout));
        indices.push_back(static_cast<std::int64_t>(entry[0]));
        place += size * header.dim;
    }
    if (place != header.numbers) refuse_damaged(path);
    const std::byte* const note_at = front + header.curves * words_of_curve * word;
    note.assign(reinterpret_cast<const char*>(note_at), header.note_bytes);
}

void OpenedIndex::check_points(Poller& poller) const {
    Checksum sum;
    poller.in_runs(end_ - points_, 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        sum.add(points_ + first, static_cast<std::size_t>(end - first));
    });
    if (sum.value() != checksum_) refuse_damaged(path);
}

std::vector<const double*> OpenedIndex::bounds_for(const pairwise::Targets& targets) const {
    std::vector<const double*> all(stored.size());
    if (layout != targets.layout() || bounds_format_ == 0 ||
        bounds_format_ != targets.bounds_format()) {
        return all;
    }
    const double* from = bounds_;
    for (std::size_t k = 0; k < stored.size(); ++k) {
        const std::ptrdiff_t count = targets.bounds_size(stored[k].size, curves[k].dim());
        if (count > end_ - from) refuse_damaged(path);
        all[k] = from;
        from += count;
    }
    if (from != end_) refuse_damaged(path);
    return all;
}

}  // namespace curvewise::nearest
