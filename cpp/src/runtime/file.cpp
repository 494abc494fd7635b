#include "runtime/file.hpp"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <io.h>
#include <windows.h>
#else
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace curvewise::runtime {
namespace {

constexpr std::uint64_t factor = 0x9E3779B97F4A7C15;  // odd, so that no product loses a bit

std::uint64_t mixed(std::uint64_t lane, std::uint64_t word) noexcept {
    const std::uint64_t product = (lane ^ word) * factor;
    return product << 29 | product >> 35;
}

// Beside the file, and not that of another thread or process.
std::string name_beside(const std::string& path) {
    static std::atomic<unsigned> next{0};
#ifdef _WIN32
    const unsigned long process = GetCurrentProcessId();
#else
    const long process = ::getpid();
#endif
    return path + "." + std::to_string(process) + "-" + std::to_string(next++) + ".tmp";
}

#ifdef _WIN32

[[noreturn]] void fail(const char* what, const std::string& path) {
    throw std::system_error(static_cast<int>(GetLastError()), std::system_category(),
                            std::string(what) + " " + path);
}

std::wstring wide(const std::string& path) {
    const int count =
        MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path.c_str(), -1, nullptr, 0);
    if (count == 0) fail("the name is not in UTF-8:", path);
    std::wstring name(static_cast<std::size_t>(count), L'\0');
    MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path.c_str(), -1, &name[0], count);
    return name;
}

// Closes it at the end.
struct Handle {
    HANDLE handle;
    ~Handle() {
        if (handle != nullptr && handle != INVALID_HANDLE_VALUE) CloseHandle(handle);
    }
};

std::FILE* created(const std::string& path, const std::string& /*like*/) {
    return _wfopen(wide(path).c_str(), L"wbx");
}
bool is_on_disk(std::FILE* file) { return _commit(_fileno(file)) == 0; }
bool is_renamed(const std::string& from, const std::string& to) {
    const DWORD flags = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
    return MoveFileExW(wide(from).c_str(), wide(to).c_str(), flags) != 0;
}
void remove_file(const std::string& path) noexcept {
    try {
        DeleteFileW(wide(path).c_str());
    } catch (...) {  // the name was converted before
    }
}
// Of the functions of C, which tell errno alone.
[[noreturn]] void fail_in_c(const char* what, const std::string& path) {
    throw std::system_error(errno, std::generic_category(), std::string(what) + " " + path);
}

#else

[[noreturn]] void fail(const char* what, const std::string& path) {
    throw std::system_error(errno, std::generic_category(), std::string(what) + " " + path);
}
[[noreturn]] void fail_in_c(const char* what, const std::string& path) { fail(what, path); }

// Closes it at the end.
struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
};

// With the permissions of the file that it replaces, if there is one.
std::FILE* created(const std::string& path, const std::string& like) {
    const int number = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (number < 0) return nullptr;
    struct stat old {};
    if (::stat(like.c_str(), &old) == 0) static_cast<void>(::fchmod(number, old.st_mode & 07777));
    std::FILE* const file = ::fdopen(number, "wb");
    if (file == nullptr) ::close(number);
    return file;
}
bool is_on_disk(std::FILE* file) { return ::fsync(::fileno(file)) == 0; }
bool is_renamed(const std::string& from, const std::string& to) {
    return std::rename(from.c_str(), to.c_str()) == 0;
}
void remove_file(const std::string& path) noexcept { ::unlink(path.c_str()); }

#endif

}  // namespace

#ifdef _WIN32

MappedFile::MappedFile(const std::string& path) {
    const DWORD sharing = FILE_SHARE_READ | FILE_SHARE_DELETE;
    const Handle file{CreateFileW(wide(path).c_str(), GENERIC_READ, sharing, nullptr, OPEN_EXISTING,
                                  FILE_ATTRIBUTE_NORMAL, nullptr)};
    if (file.handle == INVALID_HANDLE_VALUE) fail("cannot open", path);
    LARGE_INTEGER size;
    if (GetFileSizeEx(file.handle, &size) == 0) fail("cannot read the size of", path);
    if (size.QuadPart == 0) return;
    const Handle mapping{CreateFileMappingW(file.handle, nullptr, PAGE_READONLY, 0, 0, nullptr)};
    if (mapping.handle == nullptr) fail("cannot map", path);
    data_ = static_cast<const std::byte*>(MapViewOfFile(mapping.handle, FILE_MAP_READ, 0, 0, 0));
    if (data_ == nullptr) fail("cannot map", path);
    size_ = static_cast<std::size_t>(size.QuadPart);
}

MappedFile::~MappedFile() {
    if (data_ != nullptr) UnmapViewOfFile(data_);
}

#else

MappedFile::MappedFile(const std::string& path) {
    const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (file.number < 0) fail("cannot open", path);
    struct stat status {};
    if (::fstat(file.number, &status) != 0) fail("cannot read the size of", path);
    if (!S_ISREG(status.st_mode)) {
        errno = S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
        fail("cannot map", path);
    }
    if (status.st_size == 0) return;
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const data = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file.number, 0);
    if (data == MAP_FAILED) fail("cannot map", path);
    data_ = static_cast<const std::byte*>(data);
    size_ = size;
}

MappedFile::~MappedFile() {
    if (data_ != nullptr) ::munmap(const_cast<std::byte*>(data_), size_);
}

#endif

ReplacingFile::ReplacingFile(const std::string& path)
    : path_(path), name_(name_beside(path)), file_(created(name_, path)) {
    if (file_ == nullptr) fail_in_c("cannot write", path_);
}

ReplacingFile::~ReplacingFile() {
    if (file_ != nullptr) std::fclose(file_);
    if (!name_.empty()) remove_file(name_);
}

void ReplacingFile::write(const void* bytes, std::size_t count) {
    if (std::fwrite(bytes, 1, count, file_) != count) fail_in_c("cannot write", path_);
}

void ReplacingFile::rewind() {
    if (std::fseek(file_, 0, SEEK_SET) != 0) fail_in_c("cannot write", path_);
}

void ReplacingFile::replace() {
    if (std::fflush(file_) != 0 || !is_on_disk(file_)) fail_in_c("cannot write", path_);
    std::FILE* const file = file_;
    file_ = nullptr;
    if (std::fclose(file) != 0) fail_in_c("cannot write", path_);
    if (!is_renamed(name_, path_)) fail("cannot replace", path_);
    name_.clear();
}

void Checksum::add(const void* bytes, std::size_t words) noexcept {
    const auto* from = static_cast<const unsigned char*>(bytes);
    const auto next = [&] {
        std::uint64_t word = 0;
        std::memcpy(&word, from, sizeof word);
        from += sizeof word;
        return word;
    };
    const auto add_one = [&] {
        std::uint64_t& lane = lanes_[count_++ % 4];
        lane = mixed(lane, next());
        --words;
    };
    while (words > 0 && count_ % 4 != 0) add_one();
    std::uint64_t a = lanes_[0], b = lanes_[1], c = lanes_[2], d = lanes_[3];
    for (; words >= 4; words -= 4, count_ += 4) {  // none waits for another
        a = mixed(a, next());
        b = mixed(b, next());
        c = mixed(c, next());
        d = mixed(d, next());
    }
    lanes_[0] = a;
    lanes_[1] = b;
    lanes_[2] = c;
    lanes_[3] = d;
    while (words > 0) add_one();
}

std::uint64_t Checksum::value() const noexcept {
    std::uint64_t all = count_;
    for (const std::uint64_t lane : lanes_) all = mixed(all, lane);
    return all ^ all >> 32;
}

}  // namespace curvewise::runtime
