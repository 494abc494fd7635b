// Files: their bytes in memory without reading them first, and new contents in place of old ones.
// Names are in UTF-8 on Windows, and as the system has them elsewhere. std::system_error states
// what failed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace curvewise::runtime {

// The bytes of a file, which processes share. The file must not be changed meanwhile, but may be
// replaced, and removed.
class MappedFile {
   public:
    explicit MappedFile(const std::string& path);
    MappedFile(const MappedFile&) = delete;
    MappedFile(MappedFile&&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    MappedFile& operator=(MappedFile&&) = delete;
    ~MappedFile();

    const std::byte* data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }

   private:
    const std::byte* data_ = nullptr;  // null where there are none
    std::size_t size_ = 0;
};

// Writes a file beside another one, which it replaces at the end. If it does not come to that, the
// other one stays as it is.
class ReplacingFile {
   public:
    explicit ReplacingFile(const std::string& path);
    ReplacingFile(const ReplacingFile&) = delete;
    ReplacingFile(ReplacingFile&&) = delete;
    ReplacingFile& operator=(const ReplacingFile&) = delete;
    ReplacingFile& operator=(ReplacingFile&&) = delete;
    ~ReplacingFile();

    void write(const void* bytes, std::size_t count);
    // What is written next overwrites the first bytes.
    void rewind();
    // All bytes are on the disk before the name is theirs.
    void replace();

   private:
    std::string path_;
    std::string name_;  // of the file that is written
    std::FILE* file_;   // null when it is closed
};

// Of 64-bit words; another one if any single word changes.
class Checksum {
   public:
    void add(const void* bytes, std::size_t words) noexcept;
    std::uint64_t value() const noexcept;

   private:
    std::uint64_t lanes_[4] = {1, 2, 3, 4};
    std::size_t count_ = 0;
};

}  // namespace curvewise::runtime
