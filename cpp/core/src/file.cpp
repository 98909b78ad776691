#include "file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "devlearn/error.hpp"

namespace devlearn {
namespace {

constexpr const char* kWritable = "a file that can be written";

// Where a file of this name lies: a link goes on pointing at it. A device must not be replaced.
std::string place_of(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    const char* what = fs::is_directory(status) ? std::strerror(EISDIR) : "not a regular file";
    throw FileError(path, "", what, kWritable);
  }
  fs::path place = path;
  for (int links = 0; fs::is_symlink(fs::symlink_status(place, ignored)); ++links) {
    constexpr int kMostLinks = 40;
    if (links == kMostLinks) throw FileError(path, "", std::strerror(ELOOP), kWritable);
    place = place.parent_path() / fs::read_symlink(place, ignored);
  }
  return place.string();
}

// A rename is on the disk once its folder is. False, with errno, where the disk fails; where a
// folder cannot be opened or flushed at all (some network file systems), the file is whole all the
// same.
bool flush_folder(const std::string& place) {
  const std::filesystem::path folder = std::filesystem::path(place).parent_path();
  const int descriptor =
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return true;
  const int failed = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  errno = failed;
  return failed == 0 || failed == EINVAL || failed == ENOTSUP;
}

bool is_named(int descriptor, const std::string& name) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::stat(name.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

// A file of this name, empty, and locked until it is closed; -1, with errno, where there is none.
int open_locked(const std::string& name) {
  for (;;) {
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor < 0) return -1;
    int failed = 0;
    while (::flock(descriptor, LOCK_EX) != 0) {
      if (errno == EINTR) continue;
      failed = errno;
      break;
    }
    // Who held the lock before may have renamed or removed the file that was opened.
    const bool ours = failed == 0 && is_named(descriptor, name);
    if (ours && ::ftruncate(descriptor, 0) == 0) return descriptor;
    if (ours) {
      failed = errno;
      ::unlink(name.c_str());
    }
    ::close(descriptor);
    errno = failed;
    if (failed != 0) return -1;
  }
}

}  // namespace

SideFile::SideFile(const std::string& path)
    : path_(path),
      place_(place_of(path)),
      side_(place_ + ".devlearn-tmp"),
      descriptor_(open_locked(side_)) {
  if (descriptor_ < 0) refuse();
}

SideFile::~SideFile() {
  if (descriptor_ < 0) return;
  ::unlink(side_.c_str());
  ::close(descriptor_);
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
  if (::rename(side_.c_str(), place_.c_str()) != 0) refuse();
  ::close(std::exchange(descriptor_, -1));
  if (!flush_folder(place_)) refuse();
}

void SideFile::refuse() const { throw FileError(path_, "", std::strerror(errno), kWritable); }

// --- reading -------------------------------------------------------------------------------------

namespace {

constexpr const char* kReadable = "a file that can be read";

}  // namespace

std::vector<std::byte> bytes_of_file(const std::string& path) {
  const auto refuse = [&](const char* what) { throw FileError(path, "", what, kReadable); };
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) refuse(std::strerror(errno));
  struct Closed {
    int descriptor;
    ~Closed() { ::close(descriptor); }
  } const closed{descriptor};
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) refuse(std::strerror(errno));
  if (S_ISDIR(status.st_mode)) refuse(std::strerror(EISDIR));
  if (!S_ISREG(status.st_mode)) refuse("not a regular file");

  std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
  std::size_t size = 0;
  while (size < bytes.size()) {
    const auto count = ::read(descriptor, bytes.data() + size, bytes.size() - size);
    if (count < 0 && errno != EINTR) refuse(std::strerror(errno));
    if (count == 0) break;  // it was cut off meanwhile
    if (count > 0) size += static_cast<std::size_t>(count);
  }
  bytes.resize(size);
  return bytes;
}

std::string text_of_file(const std::string& path, std::size_t most) {
  std::ifstream file(path, std::ios::binary);
  std::string text;
  char part[1 << 16];
  while (file && text.size() <= most) {
    file.read(part, static_cast<std::streamsize>(std::min(sizeof part, most + 1 - text.size())));
    text.append(part, static_cast<std::size_t>(file.gcount()));
  }
  if (!file.is_open() || file.bad()) throw FileError(path, "", std::strerror(errno), kReadable);
  return text;
}

}  // namespace devlearn
