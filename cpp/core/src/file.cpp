#include "file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>
#include <thread>
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

// What lies at the name of a side file may be another's: it is never written to, only removed.
bool is_ours(int descriptor, const std::string& name) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::lstat(name.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino && S_ISREG(open.st_mode) &&
         open.st_nlink == 1 && open.st_uid == ::geteuid();
}

// Whether the name can be tried again: nothing is there now, or it is no file that we could lock.
bool is_cleared(const std::string& name) {
  struct stat named {};
  if (::lstat(name.c_str(), &named) != 0) return errno == ENOENT;
  if (S_ISDIR(named.st_mode)) return false;
  const bool another =
      !S_ISREG(named.st_mode) || named.st_nlink != 1 || named.st_uid != ::geteuid();
  return !another || ::unlink(name.c_str()) == 0;
}

// Locks a file; false, with errno, where another has it for too long.
bool is_locked(int descriptor, std::chrono::milliseconds patience) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + patience;
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    if (errno != EWOULDBLOCK || Clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

// A file of this name, empty, and locked until it is closed; -1, with errno, where there is none.
int open_locked(const std::string& name, std::chrono::milliseconds patience) {
  constexpr int kMostTries = 100;  // others may come and go, but not for ever
  for (int tries = 0; tries < kMostTries; ++tries) {
    const int descriptor =
        ::open(name.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (descriptor < 0) {
      const int failed = errno;
      const bool perhaps_another = failed == ELOOP || failed == ENXIO || failed == EACCES;
      if (perhaps_another && is_cleared(name)) {
        errno = failed;
        continue;
      }
      errno = failed;
      return -1;
    }
    const bool locked = is_locked(descriptor, patience);
    // Who held the lock before may have renamed or removed the file that was opened.
    if (locked && is_ours(descriptor, name)) {
      if (::ftruncate(descriptor, 0) == 0) return descriptor;
      const int failed = errno;
      ::unlink(name.c_str());
      ::close(descriptor);
      errno = failed;
      return -1;
    }
    const int failed = errno;
    ::close(descriptor);
    if (!locked || !is_cleared(name)) {
      errno = failed;
      return -1;
    }
  }
  errno = EBUSY;
  return -1;
}

// A file that takes another's place keeps its mode and, where that is allowed, its owner.
void take_mode_of(const std::string& place, int descriptor) {
  struct stat there {
  }, here{};
  if (::stat(place.c_str(), &there) != 0 || ::fstat(descriptor, &here) != 0) return;
  if (there.st_uid != here.st_uid || there.st_gid != here.st_gid) {
    static_cast<void>(::fchown(descriptor, there.st_uid, there.st_gid));
  }
  static_cast<void>(::fchmod(descriptor, there.st_mode & 0777));
}

}  // namespace

SideFile::SideFile(const std::string& path, std::chrono::milliseconds patience)
    : path_(path),
      place_(place_of(path)),
      side_(place_ + ".devlearn-tmp"),
      descriptor_(open_locked(side_, patience)) {
  if (descriptor_ < 0 && errno == EWOULDBLOCK) {
    throw FileError(path_, "",
                    "being written by another for " + std::to_string(patience.count()) +
                        " ms, who holds " + side_,
                    kWritable);
  }
  if (descriptor_ < 0) refuse();
  take_mode_of(place_, descriptor_);
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

InputFile::InputFile(const std::string& path) : path_(path) {
  // Opened such that a pipe without a writer does not keep it waiting.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) refuse(std::strerror(errno));
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) refuse(std::strerror(errno));
  if (S_ISDIR(status.st_mode)) refuse(std::strerror(EISDIR));
  if (!S_ISREG(status.st_mode)) refuse("not a regular file");
  size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t InputFile::read(void* into, std::size_t most) {
  char* const first = static_cast<char*>(into);
  std::size_t size = 0;
  while (size < most) {
    const auto count = ::read(descriptor_, first + size, most - size);
    if (count < 0 && errno != EINTR) refuse(std::strerror(errno));
    if (count == 0) break;  // it was cut off meanwhile
    if (count > 0) size += static_cast<std::size_t>(count);
  }
  return size;
}

void InputFile::refuse(const char* what) {
  // The destructor of what was not constructed is not called.
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  throw FileError(path_, "", what, kReadable);
}

std::uint64_t memory_here() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), bytes = ::sysconf(_SC_PAGESIZE);
  if (pages < 0 || bytes < 0) return std::numeric_limits<std::uint64_t>::max();
  const auto memory = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(bytes);
  return std::min<std::uint64_t>(memory, std::numeric_limits<std::size_t>::max());
}

std::string text_of_file(const std::string& path, std::size_t most) {
  InputFile file(path);
  std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), most + 1)), '\0');
  text.resize(file.read(text.data(), text.size()));
  return text;
}

}  // namespace devlearn
