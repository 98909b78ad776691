#include "file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "devlearn/error.hpp"

namespace devlearn {
namespace {

constexpr const char* kWritable = "a file that can be written";

// Where a file of this name lies: a link goes on pointing at it. A device must not be replaced.
std::string place_of(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) return path;
  if (!std::filesystem::is_regular_file(status)) {
    const char* what =
        std::filesystem::is_directory(status) ? std::strerror(EISDIR) : "not a regular file";
    throw FileError(path, "", what, kWritable);
  }
  const std::filesystem::path place = std::filesystem::canonical(path, ignored);
  return place.empty() ? path : place.string();
}

// A rename is on the disk once its folder is. Where a folder cannot be flushed (some network file
// systems), the file is whole all the same.
void flush_folder(const std::string& place) {
  const std::filesystem::path folder = std::filesystem::path(place).parent_path();
  const int descriptor =
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

SideFile::SideFile(const std::string& path) : path_(path), place_(place_of(path)) {
  static std::atomic<unsigned> count{0};
  do {
    side_ = place_ + ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(count++);
    descriptor_ = ::open(side_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) refuse();
}

SideFile::~SideFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!side_.empty()) ::unlink(side_.c_str());
}

void SideFile::write(const void* data, std::size_t size) {
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const auto count = ::write(descriptor_, next, size);
    if (count < 0 && errno != EINTR) refuse();
    if (count > 0) {
      next += count;
      size -= static_cast<std::size_t>(count);
    }
  }
}

void SideFile::commit() {
  if (::fsync(descriptor_) != 0) refuse();
  if (::close(std::exchange(descriptor_, -1)) != 0) refuse();
  if (::rename(side_.c_str(), place_.c_str()) != 0) refuse();
  side_.clear();
  flush_folder(place_);
}

void SideFile::refuse() const { throw FileError(path_, "", std::strerror(errno), kWritable); }

}  // namespace devlearn
